//! The variance of an estimate from windows, one of each stratum, and how well it is itself known.

use super::{CONFIDENCE, student_quantile};

/// The variance of an estimate, and how well it is itself known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// The variance; the square of the standard error.
    pub variance: f64,
    /// Degrees of freedom of the variance; 0 where it cannot be known, as of a single window.
    pub freedom: f64,
}

impl Spread {
    /// The variance of the sum of `residuals`, which come from one window in each stratum, in the order of the strata.
    ///
    /// One window says nothing of the spread within its stratum, so strata are collapsed: neighbours pair up, an odd one
    /// out makes a triple with the last pair, and what differs within a group estimates the spread within its strata, and
    /// on the safe side, since what differs between the strata adds to it (Wolter, *Introduction to Variance Estimation*,
    /// 2007, section 2.5). A group of n adds n / (n - 1) sum (e - mean)^2, for a pair the square of the difference.
    ///
    /// Degrees of freedom are Satterthwaite's (*An approximate distribution of estimates of variance components*, 1946)
    /// with what he neglects: the square of a group variance v of n - 1 degrees of freedom is v^2 (n - 1) / (n + 1) without
    /// bias, and the square of their sum is too large by twice that. They are no more than those of all groups together.
    #[must_use]
    pub fn of_sum(residuals: &[f64]) -> Self {
        let (mut variance, mut squares, mut most) = (0.0, 0.0, 0.0);
        let mut rest = residuals;
        while rest.len() >= 2 {
            let (group, later) = rest.split_at(if rest.len() == 3 { 3 } else { 2 });
            rest = later;
            let n = group.len() as f64;
            let mean = group.iter().sum::<f64>() / n;
            let of_group = group.iter().map(|e| (e - mean) * (e - mean)).sum::<f64>() * n / (n - 1.0);
            variance += of_group;
            squares += of_group * of_group * (n - 1.0) / (n + 1.0);
            most += n - 1.0;
        }
        let freedom = if squares > 0.0 { (variance * variance / squares - 2.0).clamp(1.0, most) } else { most };
        Self { variance, freedom }
    }

    /// The spread of the estimate times `factor`.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { variance: self.variance * factor * factor, ..self }
    }

    /// The spread of the sum of two independent estimates.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let variance = self.variance + other.variance;
        let share = |part: Self| if part.variance > 0.0 { part.variance * part.variance / part.freedom } else { 0.0 };
        let squares = share(self) + share(other);
        let freedom = if squares > 0.0 { variance * variance / squares } else { self.freedom + other.freedom };
        Self { variance, freedom }
    }

    /// Half the width of the interval that holds the truth 95 times of 100; not a number where the spread is not known.
    #[must_use]
    pub fn half_width(self) -> f64 {
        student_quantile(CONFIDENCE, self.freedom) * libm::sqrt(self.variance)
    }
}
