//! Columns of counts that may be estimated: of the whole stream and for each query, with half the width of their intervals.

use super::super::cache_result::CacheResult;
use super::Columns;
use pm_caches::{CacheCounts, WindowCounts};

/// How much of a window's count may as well be nothing.
pub(super) type Unknown = fn(&CacheResult) -> Box<dyn Fn(&WindowCounts) -> u64>;

/// What does not depend on what is cached.
pub(super) const NONE: Unknown = |_| Box::new(|_| 0);
/// Fetches.
pub(super) const FETCHES: Unknown = |_| Box::new(WindowCounts::unknown_fetches);
/// Bytes of fetches.
pub(super) const BYTES: Unknown = |of| {
    let line = u64::from(of.config().line_bytes());
    Box::new(move |counts| counts.unknown_fetches() * line)
};

/// Columns of caches.
impl Columns<CacheResult> {
    /// A count of the stream, or an estimate of it.
    pub(super) fn total(self, name: &str, in_table: bool, count: fn(&CacheCounts) -> u64) -> Self {
        self.number(name, in_table, move |of| of.found.total(count, NONE(of)).0)
    }

    /// The same with half the width of its interval behind it.
    pub(super) fn total_with_error(
        self,
        name: &str,
        in_table: bool,
        count: fn(&CacheCounts) -> u64,
        unknown: Unknown,
    ) -> Self {
        self.number(name, in_table, move |of| of.found.total(count, unknown(of)).0).ratio(
            &format!("{name}_error"),
            false,
            move |of| of.half_width(of.found.total(count, unknown(of)).1),
        )
    }

    /// A count for each query, with half the width of its interval behind it.
    pub(super) fn per_query(
        self,
        name: &str,
        in_table: bool,
        count: fn(&CacheCounts) -> u64,
        unknown: Unknown,
    ) -> Self {
        self.ratio(name, in_table, move |of| of.found.per_query(count, unknown(of)).value).ratio(
            &format!("{name}_error"),
            false,
            move |of| of.half_width(of.found.per_query(count, unknown(of)).half_width()),
        )
    }
}
