//! A film that does not care about order: pixels are 128-bit integers.

/// Adds up contributions to pixels, exactly the same whatever order they come in.
///
/// A contribution is rounded once, to a multiple of a unit that is fixed beforehand, and integers are added.
pub struct Film {
    sums: Vec<[i128; 3]>,
    /// A power of two, and so is how many make up 1.
    unit: f64,
    units_in_one: f64,
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
        Self { sums: vec![[0; 3]; pixels], unit, units_in_one: 1.0 / unit }
    }

    /// A contribution in units of the film, or `None` if it is beyond 2^124 of them or not a number.
    #[inline]
    #[must_use]
    pub fn quantise(&self, value: [f64; 3]) -> Option<[i128; 3]> {
        // Powers of two: the product is rounded as the quotient is.
        let units = value.map(|x| x * self.units_in_one);
        // Also false for NaN.
        units.iter().all(|x| x.abs() < 2f64.powi(124)).then(|| units.map(round))
    }

    /// Adds a quantised contribution to a pixel.
    ///
    /// # Errors
    /// [`Overflow`].
    #[inline]
    pub fn add(&mut self, pixel: u32, units: [i128; 3]) -> Result<(), Overflow> {
        let sums = &mut self.sums[pixel as usize];
        for channel in 0..3 {
            sums[channel] = sums[channel].checked_add(units[channel]).ok_or(Overflow(pixel))?;
        }
        Ok(())
    }

    /// The pixels.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "a picture's precision is f32")]
    pub fn pixels(&self) -> Vec<[f32; 3]> {
        self.sums.iter().map(|sums| sums.map(|sum| (sum as f64 * self.unit) as f32)).collect()
    }
}

/// A number below 2^124, rounded, halves away from 0. Beyond 2^52 there is nothing to round, and most are below: then this
/// takes a few instructions, where `f64::round` is a function of its own on processors of old.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "checked against 2^124, and below 2^52"
)]
fn round(x: f64) -> i128 {
    if x.abs() >= 2f64.powi(52) {
        return x as i128;
    }
    let whole = x as i64;
    let rest = x - whole as f64;
    i128::from(whole + i64::from(rest >= 0.5) - i64::from(rest <= -0.5))
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
        let edges = [0.0, -0.0, 0.5, least, 1.5, 2.5, 2f64.powi(52) - 0.5, 2f64.powi(52), 2f64.powi(63), 1e-320];
        for units in some.chain(edges) {
            for units in [units, -units] {
                let quantised = film.quantise([units * 2f64.powi(-64); 3]).unwrap();
                assert_eq!(quantised, [units.round() as i128; 3], "{units}");
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
}
