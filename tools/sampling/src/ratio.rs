//! Ratios and totals estimated from windows, one of each stratum.

use super::{CONFIDENCE, Spread, student_quantile};

/// A ratio of two sums over the windows of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ratio {
    /// The ratio; not a number if nothing is below the line.
    pub value: f64,
    /// The sum below the line, by which ratios of several samples are weighted.
    pub weight: f64,
    /// How far the ratio may be off by chance.
    pub spread: Spread,
    /// How far it may be off beside, as what is above the line is known between bounds only. No number of windows makes it
    /// less.
    pub doubt: f64,
}

impl Ratio {
    /// The ratio of the sums of `above` and `below`, of one window in each stratum, in the order of the strata.
    ///
    /// Its variance is that of the sum of the residuals `above - value * below`, over the square of the sum below
    /// (Cochran, *Sampling Techniques*, 1977, section 6.10: the combined ratio estimate).
    #[must_use]
    pub fn of(above: &[f64], below: &[f64]) -> Self {
        let weight = below.iter().sum::<f64>();
        let value = above.iter().sum::<f64>() / weight;
        let residuals: Vec<f64> = above.iter().zip(below).map(|(above, below)| above - value * below).collect();
        Self { value, weight, spread: Spread::of_sum(&residuals).scaled(1.0 / weight), doubt: 0.0 }
    }

    /// The same where of each `most` above the line as much as `unknown` may be nothing: the middle of the bounds.
    #[must_use]
    pub fn between(most: &[f64], unknown: &[f64], below: &[f64]) -> Self {
        let middle: Vec<f64> = most.iter().zip(unknown).map(|(most, unknown)| most - unknown / 2.0).collect();
        let ratio = Self::of(&middle, below);
        Self { doubt: unknown.iter().sum::<f64>() / 2.0 / ratio.weight, ..ratio }
    }

    /// The sum of all strata, of whose whole the windows are a `share`.
    #[must_use]
    pub fn total(most: &[f64], unknown: &[f64], share: f64) -> Self {
        let middle: Vec<f64> = most.iter().zip(unknown).map(|(most, unknown)| most - unknown / 2.0).collect();
        Self {
            value: middle.iter().sum::<f64>() / share,
            weight: share,
            spread: Spread::of_sum(&middle).scaled(1.0 / share),
            doubt: unknown.iter().sum::<f64>() / 2.0 / share,
        }
    }

    /// A ratio as a table has it: with half the width of its interval, of which `doubt` is a part. Nothing is known of the
    /// spread without degrees of freedom.
    #[must_use]
    pub fn of_interval(value: f64, weight: f64, half_width: f64, doubt: f64, freedom: f64) -> Self {
        let error = (half_width - doubt) / student_quantile(CONFIDENCE, freedom);
        let spread = if freedom > 0.0 { Spread { variance: error * error, freedom } } else { Spread::default() };
        Self { value, weight, spread, doubt }
    }

    /// The ratio of two samples drawn independently, as of one: weighted by what each has below the line.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        let weight = self.weight + other.weight;
        let (mine, its) = (self.weight / weight, other.weight / weight);
        Self {
            value: self.value * mine + other.value * its,
            weight,
            spread: self.spread.scaled(mine).plus(other.spread.scaled(its)),
            doubt: self.doubt * mine + other.doubt * its,
        }
    }

    /// Half the width of the interval that holds the truth 95 times of 100: what chance and doubt make of it.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        self.spread.half_width() + self.doubt
    }
}

#[cfg(test)]
mod tests;
