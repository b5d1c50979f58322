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
