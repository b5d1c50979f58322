//! What the windows of a sample tell of one cache.

use pm_sampling::Ratio;

use super::WindowCounts;
use crate::CacheConfig;

/// What the windows of a sample tell of one cache.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowedCounts {
    /// The cache, as it was simulated.
    pub config: CacheConfig,
    /// Blocks of memory: bytes of all regions over bytes of a line, rounded up. Known, not estimated.
    pub blocks: u64,
    /// The part of the stream that the windows measure, if that is known.
    pub share: Option<f64>,
    /// Queries simulated, warm-up included.
    pub queries_simulated: u64,
    /// What each window costs, in the order of the stream; those without any query are among them.
    pub windows: Vec<WindowCounts>,
}

impl WindowedCounts {
    /// Windows in which the state was not exact when warm-up ended.
    #[must_use]
    pub fn windows_inexact(&self) -> u64 {
        self.windows.iter().filter(|of| !of.exact).count() as u64
    }

    /// Queries that count.
    #[must_use]
    pub fn queries_measured(&self) -> u64 {
        self.windows.iter().map(|of| of.cache.queries).sum()
    }

    /// What some of the windows, by their places, would have told.
    #[must_use]
    pub fn of_windows(&self, windows: impl IntoIterator<Item = usize>) -> Self {
        let windows = windows.into_iter().map(|window| self.windows[window].clone()).collect();
        Self { windows, share: None, ..Self { windows: vec![], ..*self } }
    }

    fn each(&self, number: impl Fn(&WindowCounts) -> u64) -> Vec<f64> {
        self.windows.iter().map(|of| number(of) as f64).collect()
    }

    /// The ratio of two counts, such as reads to queries. Of the first, what `unknown` counts may as well be nothing.
    pub fn ratio(
        &self,
        count: impl Fn(&WindowCounts) -> u64,
        unknown: impl Fn(&WindowCounts) -> u64,
        below: impl Fn(&WindowCounts) -> u64,
    ) -> Ratio {
        Ratio::between(&self.each(count), &self.each(unknown), &self.each(below))
    }

    /// Fetches for each query.
    #[must_use]
    pub fn fetches_per_query(&self) -> Ratio {
        self.ratio(|of| of.cache.fetches, WindowCounts::unknown_fetches, |of| of.cache.queries)
    }

    /// A count of the whole stream: that of the windows over their share of it. Not a number where that is not known.
    pub fn total(&self, count: impl Fn(&WindowCounts) -> u64, unknown: impl Fn(&WindowCounts) -> u64) -> Ratio {
        Ratio::total(&self.each(count), &self.each(unknown), self.share.unwrap_or(f64::NAN))
    }
}
