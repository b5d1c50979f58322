//! What a cache costs in one window.

use crate::CacheCounts;

/// What a cache costs in a window.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WindowCounts {
    /// The counts of the cache, as if the cache were empty when the window begins. `compulsory` says nothing: what is first
    /// touched in the whole stream a window does not know.
    pub cache: CacheCounts,
    /// Fetches of each region of which it is not known whether they are any.
    pub unknown: Vec<u64>,
    /// The state was exact when warm-up ended.
    pub exact: bool,
    /// Distinct lines of each search, added up, if that was asked for.
    pub search_lines: Option<u64>,
}

impl WindowCounts {
    /// What a simulation counted of a cache.
    pub(super) fn of(mut cache: CacheCounts, unknown: Vec<u64>, exact: bool) -> Self {
        let search_lines = cache.more.working_sets.take().map(|sets| sets.per_search.sum());
        Self { cache, unknown, exact, search_lines }
    }

    /// Fetches of all regions of which it is not known whether they are any.
    #[must_use]
    pub fn unknown_fetches(&self) -> u64 {
        self.unknown.iter().sum()
    }
}
