//! The columns that `pm-cachesim` prints of a trace of windows, and how those of several samples become one.

/// How the values of several samples become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Merge {
    /// All samples have the same.
    Same,
    /// Words of each, one after the other.
    Words,
    /// Of all samples together: counts of what was simulated.
    Sum,
    /// A count of the whole stream: the mean, weighted by the share that a sample is of it, as a whole number.
    Count,
    /// A number of the whole stream: the mean, weighted so.
    Whole,
    /// A number for each query, search or fetch: the mean, weighted by the queries that were measured.
    Each,
    /// Half the width of the interval of a number of the whole stream: so weighted, they add up as squares.
    WholeError,
    /// The same of a number for each query.
    EachError,
    /// Fetches per query, as [`pm_sampling::Ratio`] puts them together.
    Ratio,
}

use Merge::{Count, Each, EachError, Ratio, Same, Sum, Whole, WholeError, Words};

/// Fetches per query, the number that windows are added for.
pub(super) const FETCHES: &str = "fetches_per_query";
/// Half the width of its interval.
pub(super) const HALF_WIDTH: &str = "fetches_per_query_error";
/// The part of it that no number of windows makes less.
pub(super) const DOUBT: &str = "fetches_per_query_doubt";
/// How well its spread is known.
pub(super) const FREEDOM: &str = "degrees_of_freedom";
/// Windows of the sample.
pub(super) const WINDOWS: &str = "windows";
/// Queries in them, without warm-up.
pub(super) const MEASURED: &str = "queries_measured";
/// Queries simulated, with warm-up.
pub(super) const SIMULATED: &str = "queries_simulated";
/// Part of the stream that the windows measure.
pub(super) const SHARE: &str = "sample_share";

/// All columns but those of regions.
pub(super) const COLUMNS: &[(&str, Merge)] = &[
    ("trace", Same),
    ("map", Same),
    ("order", Same),
    ("sample", Words),
    ("cache", Same),
    ("lanes", Same),
    ("cache_bytes", Same),
    ("ways", Same),
    ("line_bytes", Same),
    ("policy", Same),
    ("queries", Count),
    ("reads", Count),
    ("raw_bytes", Count),
    ("accesses", Count),
    ("fetches", Count),
    ("fetches_error", WholeError),
    ("bytes_fetched", Count),
    ("bytes_fetched_error", WholeError),
    ("bytes_written_back", Count),
    ("compulsory", Count),
    ("blocks", Same),
    ("reads_per_query", Each),
    ("reads_per_query_error", EachError),
    ("accesses_per_query", Each),
    ("accesses_per_query_error", EachError),
    (FETCHES, Ratio),
    (HALF_WIDTH, Ratio),
    (DOUBT, Ratio),
    (FREEDOM, Ratio),
    ("fetches_per_block", Whole),
    ("fetches_per_block_error", WholeError),
    ("bytes_per_query", Each),
    ("bytes_per_query_error", EachError),
    ("capacity", Count),
    ("conflict", Count),
    ("page_switches", Count),
    ("page_switches_per_fetch", Each),
    ("searches", Count),
    ("lines_per_search_mean", Each),
    ("lines_per_search_p50", Count),
    ("lines_per_search_p90", Count),
    ("lines_per_search_max", Count),
    ("batches", Count),
    ("lines_per_batch_mean", Whole),
    ("lines_per_batch_p50", Count),
    ("lines_per_batch_p90", Count),
    ("lines_per_batch_max", Count),
    ("batch_floor", Count),
    ("query_bytes", Count),
    ("result_bytes", Count),
    ("total_bytes", Count),
    ("order_bytes_on_chip", Same),
    (WINDOWS, Sum),
    ("windows_inexact", Sum),
    (MEASURED, Sum),
    (SIMULATED, Sum),
    (SHARE, Sum),
    ("history", Words),
];

/// Columns of regions of the map: their fetches, and half the width of the interval.
const OF_REGIONS: &str = "fetches_";

/// How a column becomes one; none if it is no column of a trace of windows.
pub(super) fn merge(name: &str) -> Option<Merge> {
    let known = COLUMNS.iter().find(|(known, _)| *known == name).map(|(_, merge)| *merge);
    known.or_else(|| {
        let region = name.strip_prefix(OF_REGIONS)?;
        Some(if region.ends_with("_error") { WholeError } else { Count })
    })
}
