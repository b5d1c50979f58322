//! A film that does not care about order: pixels are 128-bit integers.

use std::hint::black_box;

/// Adds up contributions to pixels, exactly the same whatever order they come in.
///
/// A contribution is rounded once, to a multiple of a unit that is fixed beforehand, and integers are added.
pub struct Film {
    /// The lower halves of the sums: all that most contributions touch. Pixels come in any order, so that each is a miss of some
    /// cache, and half as many bytes are half as many of them.
    low: Vec<[u64; 3]>,
    /// The upper halves.
    high: Vec<[i64; 3]>,
    /// A power of two, and so is how many make up 1.
    unit: f64,
    units_in_one: f64,
}

/// Contributions whose pixels are asked for at once.
const TOGETHER: usize = 32;

/// A contribution in units of a film: three whole numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units(Size);

/// How large they are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Size {
    /// Below 2^62, as nearly all.
    Small([i64; 3]),
    /// Below 2^124: doubles hold them exactly.
    Large([f64; 3]),
}

/// A pixel's sum, or a contribution to it, does not fit: the light is some 2^60 times what the scene's power and size
/// suggest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "pixel {0} is brighter than the film can hold (2^60 times the photons' flux over the scene's size squared); \
     is the scene's scale right?"
)]
pub struct Overflow(pub u32);

impl Film {
    /// A black film for values around `scale`: its unit is 2^-64 of the power of two at or below it.
    #[must_use]
    pub fn new(pixels: usize, scale: f64) -> Self {
        // Scales without meaning (an empty map, a scene without size) are served as well as 1.
        let scale = if scale.is_normal() && scale > 0.0 { scale.clamp(1e-200, 1e200) } else { 1.0 };
        // The power of two at or below: the bits without the mantissa.
        let power = f64::from_bits(scale.to_bits() & !0x000f_ffff_ffff_ffff);
        let unit = power / 2f64.powi(64);
        Self { low: vec![[0; 3]; pixels], high: vec![[0; 3]; pixels], unit, units_in_one: 1.0 / unit }
    }

    /// A contribution in units of the film, or `None` if it is beyond 2^124 of them or not a number.
    #[inline]
    #[must_use]
    pub fn quantise(&self, value: [f64; 3]) -> Option<Units> {
        // Powers of two: the product is rounded as the quotient is.
        let units = value.map(|x| x * self.units_in_one);
        // Also false for NaN.
        let are_below = |power| units.iter().all(|x| x.abs() < 2f64.powi(power));
        if are_below(62) {
            return Some(Units(Size::Small(units.map(round))));
        }
        are_below(124).then(|| Units(Size::Large(units.map(f64::round))))
    }

    /// Adds quantised contributions to pixels.
    ///
    /// # Errors
    /// [`Overflow`].
    pub fn add_all(&mut self, contributions: &[(u32, Units)]) -> Result<(), Overflow> {
        for some in contributions.chunks(TOGETHER) {
            // Asked for all at once before the first is added to: each is a miss of the caches and of the table of pages.
            let asked = some.iter().fold(0, |asked, &(pixel, _)| asked | self.low[pixel as usize][0]);
            black_box(asked);
            for &(pixel, units) in some {
                self.add(pixel, units)?;
            }
        }
        Ok(())
    }

    /// Adds a quantised contribution to a pixel.
    ///
    /// # Errors
    /// [`Overflow`].
    #[inline]
    pub fn add(&mut self, pixel: u32, units: Units) -> Result<(), Overflow> {
        if let Units(Size::Small(units)) = units {
            let low = &mut self.low[pixel as usize];
            let sums: [_; 3] =
                std::array::from_fn(|channel| low[channel].overflowing_add(units[channel].cast_unsigned()));
            if (units[0] | units[1] | units[2]) >= 0 && !(sums[0].1 | sums[1].1 | sums[2].1) {
                *low = sums.map(|sum| sum.0);
                return Ok(());
            }
        }
        self.add_whole(pixel, units)
    }

    /// The same for contributions that change the upper halves.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "halves are cut off on purpose")]
    fn add_whole(&mut self, pixel: u32, units: Units) -> Result<(), Overflow> {
        let (low, high) = (&mut self.low[pixel as usize], &mut self.high[pixel as usize]);
        for channel in 0..3 {
            let sum = whole(low[channel], high[channel]);
            let sum = sum.checked_add(units.whole(channel)).ok_or(Overflow(pixel))?;
            (low[channel], high[channel]) = (sum as u64, (sum >> 64) as i64);
        }
        Ok(())
    }

    /// The pixels.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "a picture's precision is f32")]
    pub fn pixels(&self) -> Vec<[f32; 3]> {
        let developed = |(low, high): (&[u64; 3], &[i64; 3])| {
            [0, 1, 2].map(|channel| (whole(low[channel], high[channel]) as f64 * self.unit) as f32)
        };
        self.low.iter().zip(&self.high).map(developed).collect()
    }
}

impl Units {
    #[expect(clippy::cast_possible_truncation, reason = "below 2^124")]
    const fn whole(&self, channel: usize) -> i128 {
        match &self.0 {
            Size::Small(units) => units[channel] as i128,
            Size::Large(units) => units[channel] as i128,
        }
    }
}

/// A sum of two halves.
const fn whole(low: u64, high: i64) -> i128 {
    (high as i128) << 64 | low as i128
}

/// A number below 2^62, rounded, halves away from 0: a few instructions, where `f64::round` is a function of its own on processors
/// of old. Beyond 2^52 all are whole.
#[inline]
#[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "below 2^62, and whole beyond 2^52")]
fn round(x: f64) -> i64 {
    let whole = x as i64;
    let rest = x - whole as f64;
    whole + i64::from(rest >= 0.5) - i64::from(rest <= -0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    #[test]
    fn the_film_is_free_of_order_at_any_scale() {
        for scale in [1e-30, 1e-12, 1.0, 1e12, 1e30] {
            let mut random = Random::new(&[3]);
            let values: Vec<[f64; 3]> = (0..1000)
                .map(|_| [(); 3].map(|()| scale * f64::from(random.unit()) / f64::from(random.unit() + 1e-6)))
                .collect();
            let expose = |values: &mut dyn Iterator<Item = &[f64; 3]>| {
                let mut film = Film::new(1, scale);
                values.for_each(|&value| film.add(0, film.quantise(value).unwrap()).unwrap());
                film.pixels()[0]
            };
            let forth = expose(&mut values.iter());
            assert_eq!(forth, expose(&mut values.iter().rev()));
            let sum: f64 = values.iter().map(|value| value[0]).sum();
            assert!((f64::from(forth[0]) / sum - 1.0).abs() < 1e-6, "{scale}: {forth:?} {sum}");
        }
    }

    #[test]
    fn contributions_are_rounded_to_the_nearest_unit_and_halves_away_from_nothing() {
        let film = Film::new(1, 1.0);
        let mut random = Random::new(&[4]);
        let some = (0..10_000).map(|_| (f64::from(random.unit()) - 0.5) * 2f64.powi((random.unit() * 120.0) as i32));
        let least = 0.5 - f64::EPSILON / 4.0;
        let powers = [52, 53, 61, 62, 63, 64].map(|power| 2f64.powi(power));
        let edges = [0.0, -0.0, 0.5, least, 1.5, 2.5, 2f64.powi(52) - 0.5, 1e-320];
        let edges = edges.into_iter().chain(powers.into_iter().flat_map(|x| [x.next_down(), x, x.next_up()]));
        for units in some.chain(edges) {
            for units in [units, -units] {
                let quantised = film.quantise([units * 2f64.powi(-64); 3]).unwrap();
                assert_eq!(quantised.whole(0), units.round() as i128, "{units}");
                assert_eq!([1, 2].map(|channel| quantised.whole(channel)), [quantised.whole(0); 2]);
            }
        }
    }

    #[test]
    fn too_much_light_is_an_error_and_not_a_wrong_pixel() {
        let mut film = Film::new(2, 1.0);
        assert_eq!(film.quantise([1e30, 0.0, 0.0]), None);
        assert_eq!(film.quantise([f64::NAN, 0.0, 0.0]), None);
        let most = film.quantise([2f64.powi(59); 3]).unwrap();
        let mut outcome = Ok(());
        for _ in 0..20 {
            outcome = outcome.and_then(|()| film.add(1, most));
        }
        assert_eq!(outcome, Err(Overflow(1)));
    }

    #[test]
    fn sums_are_those_of_whole_numbers_of_128_bits() {
        let mut random = Random::new(&[5]);
        let mut film = Film::new(3, 1.0);
        let mut sums = [[0_i128; 3]; 3];
        for step in 0..30_000 {
            // Small ones and some of more than 64 bits; in the last third most are negative.
            let value = [(); 3].map(|()| {
                let size = 2f64.powi((random.unit() * 120.0) as i32 - 80);
                (f64::from(random.unit()) - [0.0, 0.3, 1.6][step / 10_000]) * size
            });
            let pixel = step % 3;
            film.add(pixel as u32, film.quantise(value).unwrap()).unwrap();
            for channel in 0..3 {
                sums[pixel][channel] += (value[channel] * 2f64.powi(64)).round() as i128;
            }
        }
        let expected = sums.map(|sums| sums.map(|sum| (sum as f64 * 2f64.powi(-64)) as f32));
        assert!(sums.as_flattened().iter().any(|&sum| sum < 0), "{sums:?}");
        assert_eq!(film.pixels(), expected);
        for (pixel, sums) in sums.iter().enumerate() {
            assert_eq!([0, 1, 2].map(|channel| whole(film.low[pixel][channel], film.high[pixel][channel])), *sums);
        }
    }
}
