//! Squares of differences between independent replicates, without the noise of what is squared.
//!
//! Of two independent measurements d1 and d2 of the same difference, with noise, the mean of d1 d2 is the square of the
//! difference: the noise of one knows nothing of that of the other. So a bias far below the noise of a pixel is seen in the mean
//! over pixels.

use crate::Estimate;
use pm_pictures::REL_MSE_EPSILON;

/// Radiance of each pixel.
pub(crate) type Values = Vec<[f64; 3]>;

/// What errors of pixels count, by their true radiance as well as it is known.
pub(crate) struct Weights(Vec<[f64; 3]>);

impl Weights {
    /// As `pm-view` has it in relMSE: 1 / (a^2 + 0.01).
    pub(crate) fn of(truth: &Values) -> Self {
        Self(truth.iter().map(|pixel| pixel.map(|a| 1.0 / (a * a + REL_MSE_EPSILON))).collect())
    }

    /// The same times how many pixels each of them stands for.
    pub(crate) fn times(mut self, stand_for: &[f64]) -> Self {
        self.0.iter_mut().zip(stand_for).for_each(|(pixel, factor)| pixel.iter_mut().for_each(|w| *w *= factor));
        self
    }

    /// The weighted mean of the products of two differences, a1 - a2 and b1 - b2.
    pub(crate) fn product(&self, [a1, a2]: [&Values; 2], [b1, b2]: [&Values; 2]) -> Estimate {
        Estimate::mean(&self.products([a1, a2], [b1, b2]))
    }

    /// The same, pixel by pixel.
    pub(crate) fn products(&self, [a1, a2]: [&Values; 2], [b1, b2]: [&Values; 2]) -> Vec<f64> {
        let of_pixel = |p: usize| {
            let of_channel = |c: usize| self.0[p][c] * (a1[p][c] - a2[p][c]) * (b1[p][c] - b2[p][c]);
            (0..3).map(of_channel).sum::<f64>() / 3.0
        };
        (0..self.0.len()).map(of_pixel).collect()
    }

    /// The variance of one of two replicates: half the mean square of their difference.
    pub(crate) fn variance(&self, a: &Values, b: &Values) -> Estimate {
        self.product([a, b], [a, b]).scaled(0.5)
    }
}

/// The sum of two pictures.
pub(crate) fn sum(a: &Values, b: &Values) -> Values {
    a.iter().zip(b).map(|(a, b)| [0, 1, 2].map(|c| a[c] + b[c])).collect()
}

/// The mean of pictures.
pub(crate) fn mean<'a>(pictures: impl IntoIterator<Item = &'a Values>) -> Values {
    let mut pictures = pictures.into_iter();
    let Some(first) = pictures.next() else { return vec![] };
    let (mut total, mut n) = (first.clone(), 1.0);
    for picture in pictures {
        total = sum(&total, picture);
        n += 1.0;
    }
    total.into_iter().map(|pixel| pixel.map(|x| x / n)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    /// Pixels of radiance 1 with noise of rays (each set its own), noise of photons (alike for all rays) and a bias.
    struct World {
        random: Random,
    }

    const PIXELS: usize = 20_000;

    impl World {
        fn noise(&mut self, deviation: f64) -> Values {
            let mut one = || {
                let x: f64 = (0..12).map(|_| f64::from(self.random.unit())).sum::<f64>() - 6.0;
                deviation * x
            };
            (0..PIXELS).map(|_| [(); 3].map(|()| one())).collect()
        }
    }

    #[test]
    fn each_part_of_the_error_is_told_from_the_others() {
        let mut world = World { random: Random::new(&[7]) };
        let truth: Values = vec![[1.0; 3]; PIXELS];
        let weights = Weights::of(&truth);
        let bias: Values = (0..PIXELS).map(|p| [if p % 2 == 0 { 0.02 } else { -0.02 }; 3]).collect();
        let biased = sum(&truth, &bias);
        let maps = [world.noise(0.05), world.noise(0.05)];
        let rays: [Values; 2] = [world.noise(0.2), world.noise(0.2)];
        let seen = |m: usize, r: usize| sum(&sum(&biased, &maps[m]), &rays[r]);
        let near = |found: Estimate, expected: f64| {
            let expected = expected / 1.01;
            let error = libm::sqrt(found.spread.variance);
            assert!((found.value - expected).abs() < 4.0 * error, "{found:?}, not {expected}");
            assert!(error < 0.05 * expected.max(0.005), "{found:?} is vague");
        };
        near(weights.variance(&seen(0, 0), &seen(0, 1)), 0.04);
        // Alike for both sets of rays.
        near(weights.product([&seen(0, 0), &seen(1, 0)], [&seen(0, 1), &seen(1, 1)]).scaled(0.5), 0.0025);
        // Alike for everything: a hundredth of the noise of rays.
        near(weights.product([&seen(0, 0), &truth], [&seen(1, 1), &truth]), 0.0004);
    }

    #[test]
    fn dark_pixels_count_as_pm_view_counts_them() {
        let weights = Weights::of(&vec![[0.0, 1.0, 3.0]]);
        let (a, b) = (vec![[0.1, 1.0, 3.0]], vec![[0.0, 1.1, 3.1]]);
        let expected = (0.01 / 0.01 + 0.01 / 1.01 + 0.01 / 9.01) / 3.0;
        assert!((weights.product([&a, &b], [&a, &b]).value - expected).abs() < 1e-12);
    }
}
