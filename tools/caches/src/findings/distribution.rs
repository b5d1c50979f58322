//! How a count is distributed over searches or batches.

use std::collections::BTreeMap;

/// How a count is distributed over the searches or batches of a trace.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Distribution {
    /// Searches or batches by their count.
    numbers: BTreeMap<u32, u64>,
}

impl Distribution {
    pub(crate) fn add(&mut self, count: u32) {
        *self.numbers.entry(count).or_default() += 1;
    }

    /// How many searches or batches.
    #[must_use]
    pub fn number(&self) -> u64 {
        self.numbers.values().sum()
    }

    /// Sum of all counts.
    #[must_use]
    pub fn sum(&self) -> u64 {
        self.numbers.iter().map(|(&count, number)| u64::from(count) * number).sum()
    }

    /// Mean count; not a number if there is none.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.sum() as f64 / self.number() as f64
    }

    /// The least count that `percent` percent do not exceed (nearest rank); `None` if there is none.
    #[must_use]
    pub fn percentile(&self, percent: u64) -> Option<u32> {
        let rank = (u128::from(self.number()) * u128::from(percent)).div_ceil(100).max(1);
        let mut seen = 0;
        self.numbers
            .iter()
            .find(|&(_, &number)| {
                seen += u128::from(number);
                seen >= rank
            })
            .map(|(&count, _)| count)
    }

    /// The greatest count.
    #[must_use]
    pub fn max(&self) -> Option<u32> {
        self.numbers.last_key_value().map(|(&count, _)| count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_nearest_ranks() {
        let mut distribution = Distribution::default();
        assert_eq!((distribution.percentile(50), distribution.max(), distribution.number()), (None, None, 0));
        assert!(distribution.mean().is_nan());
        for count in [15, 20, 35, 40, 50] {
            distribution.add(count);
        }
        // The textbook's example of the nearest-rank method.
        let ranks = [5, 30, 40, 50, 100].map(|percent| distribution.percentile(percent).unwrap());
        assert_eq!(ranks, [15, 20, 20, 35, 50]);
        assert_eq!((distribution.sum(), distribution.mean(), distribution.max()), (160, 32.0, Some(50)));
    }
}
