//! Means over pixels, and how far they may be off.

use pm_sampling::{Spread, student_quantile};

/// An estimate with its spread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The estimate; without bias, so that one of a small square may be below 0.
    pub value: f64,
    /// How far it may be off by chance.
    pub spread: Spread,
}

impl Estimate {
    /// The mean of what stratified pixels say, neighbours beside each other.
    #[must_use]
    pub fn mean(of_pixels: &[f64]) -> Self {
        let n = of_pixels.len() as f64;
        Self { value: of_pixels.iter().sum::<f64>() / n, spread: Spread::of_sum(of_pixels).scaled(1.0 / n) }
    }

    /// The mean of estimates that are not independent: the spread is that of one of them.
    #[must_use]
    pub fn average(estimates: &[Self]) -> Self {
        let n = estimates.len() as f64;
        let spread = |field: fn(&Spread) -> f64| estimates.iter().map(|one| field(&one.spread)).sum::<f64>() / n;
        Self {
            value: estimates.iter().map(|one| one.value).sum::<f64>() / n,
            spread: Spread { variance: spread(|s| s.variance), freedom: spread(|s| s.freedom) },
        }
    }

    /// What another of the kind of these values will be, two of them at least: their mean, and how far one that is drawn like them lies
    /// from that (a prediction interval: Hahn and Meeker, *Statistical Intervals*, 1991, section 4.7).
    #[must_use]
    pub fn of_another(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
        let variance = squares / (n - 1.0) * (1.0 + 1.0 / n);
        Self { value: mean, spread: Spread { variance, freedom: n - 1.0 } }
    }

    /// The product of independent estimates that are far from 0, next to how far they may be off.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            spread: self.spread.scaled(other.value).plus(other.spread.scaled(self.value)),
        }
    }

    /// The estimate times a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { value: self.value * factor, spread: self.spread.scaled(factor) }
    }

    /// The sum of independent estimates.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, spread: self.spread.plus(other.spread) }
    }

    /// The bound that the truth is below with this chance.
    #[must_use]
    pub fn upper(&self, confidence: f64) -> f64 {
        self.value + self.one_sided(confidence)
    }

    /// The bound that the truth is above with this chance.
    #[must_use]
    pub fn lower(&self, confidence: f64) -> f64 {
        self.value - self.one_sided(confidence)
    }

    /// How far a bound on one side is off. What lies beyond is half of what lies beyond on both sides.
    fn one_sided(&self, confidence: f64) -> f64 {
        if self.spread.variance <= 0.0 {
            return 0.0;
        }
        student_quantile((2.0 * confidence - 1.0).max(0.0), self.spread.freedom) * libm::sqrt(self.spread.variance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    /// A number of mean 0 and variance 1, nearly normal.
    fn normal(random: &mut Random) -> f64 {
        (0..12).map(|_| f64::from(random.unit())).sum::<f64>() - 6.0
    }

    #[test]
    fn another_one_is_where_it_is_foretold() {
        let mut held = 0;
        for seed in 0..4000 {
            let mut random = Random::new(&[seed]);
            let mut draw = || 50.0 + 2.0 * normal(&mut random);
            let foretold = Estimate::of_another(&[draw(), draw(), draw(), draw()]);
            let another = draw();
            held += u32::from((foretold.lower(0.95)..=foretold.upper(0.95)).contains(&another));
        }
        // Both bounds of 95 % are held nine times in ten; three standard deviations of that count.
        assert!((3543..=3657).contains(&held), "{held}");
    }

    #[test]
    fn a_product_is_as_far_off_as_its_factors_are() {
        let of = |value: f64, relative: f64| Estimate {
            value,
            spread: Spread { variance: (value * relative) * (value * relative), freedom: 1e9 },
        };
        let product = of(2000.0, 0.03).times(of(1.5, 0.04));
        assert!((product.value - 3000.0).abs() < 1e-9);
        assert!((libm::sqrt(product.spread.variance) / 3000.0 - 0.05).abs() < 1e-9);
        // What is known for sure adds nothing.
        assert_eq!(of(7.0, 0.0).times(of(2.0, 0.0)).spread.variance, 0.0);
    }

    /// Is the bound of so many per cent above the truth so often? Squares of normal numbers, as noise is measured, have a
    /// skew that Student's t does not know of; with 400 of them it hardly matters.
    #[test]
    fn bounds_hold_as_often_as_they_say() {
        let mut held = 0;
        for seed in 0..1000 {
            let mut random = Random::new(&[seed]);
            let mut normal = || (0..12).map(|_| f64::from(random.unit())).sum::<f64>() - 6.0;
            let squares: Vec<f64> = (0..400).map(|_| normal()).map(|x| x * x).collect();
            held += u32::from(Estimate::mean(&squares).upper(0.95) >= 1.0);
        }
        assert!((925..=965).contains(&held), "{held} of 1000");
    }

    #[test]
    fn what_does_not_vary_is_known() {
        let certain = Estimate::mean(&[2.0; 8]);
        assert_eq!((certain.value, certain.upper(0.95), certain.lower(0.95)), (2.0, 2.0, 2.0));
    }
}
