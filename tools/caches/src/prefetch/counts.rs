//! What prefetching was good for.

use super::Prefetcher;

/// What a cache with a prefetcher did beside the same cache without. Lines of warm-up count nowhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrefetchCounts {
    /// What was brought in.
    pub prefetcher: Prefetcher,
    /// Misses that are left.
    pub fetches: u64,
    /// Misses of the same cache without.
    pub fetches_without: u64,
    /// Lines brought in that nobody had asked for.
    pub prefetched: u64,
    /// Those among them that were asked for before they left.
    pub used: u64,
}

impl PrefetchCounts {
    /// Share of what was prefetched that was used.
    #[must_use]
    pub fn accuracy(&self) -> f64 {
        self.used as f64 / self.prefetched as f64
    }

    /// Share of the misses without that is avoided; below zero where what is prefetched drives out more than it brings.
    #[must_use]
    pub fn coverage(&self) -> f64 {
        1.0 - self.fetches as f64 / self.fetches_without as f64
    }

    /// Lines from memory, prefetched ones with them, over those without.
    #[must_use]
    pub fn traffic(&self) -> f64 {
        (self.fetches + self.prefetched) as f64 / self.fetches_without as f64
    }
}
