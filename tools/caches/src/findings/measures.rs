//! What to find out besides the caches' own counts.

use super::ResultMemory;
use crate::Dram;

/// What to find out in the same reading of the trace, besides the rows of the caches. By default nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measures {
    /// Line sizes, in bytes, to find the miss curve of.
    pub curves: Vec<u32>,
    /// Share of the lines to find sampled curves from, of the same line sizes; above 0 and at most 1.
    pub sampled: Option<f64>,
    /// Find the exact curves beside the sampled ones.
    pub exact_too: bool,
    /// Run each cache's fully associative LRU twin along, to tell capacity misses from conflict misses.
    pub split: bool,
    /// DRAM page in bytes, a power of two, to count page switches.
    pub page_bytes: Option<u64>,
    /// A DRAM whose open rows the fetches meet.
    pub dram: Option<Dram>,
    /// Count misses that the fully associative LRU twin misses too, to tell capacity from conflict miss by miss; with `split`.
    pub miss_by_miss: bool,
    /// Find the longest chain of misses of each search, of a trace that says what its reads
    /// [wait for](pm_formats::trace::Waits).
    pub miss_chains: bool,
    /// Tell when the first cache writes lines back: for a stream of its misses.
    pub write_backs: bool,
    /// Count the distinct lines of searches and batches.
    pub working_sets: bool,
    /// Count the traffic of results.
    pub results: Option<ResultMemory>,
    /// The rule for records that span lines.
    pub span: SpanRule,
}

impl Measures {
    /// Whether curves are to be exact: always, unless they are to be sampled and nothing else is said.
    pub(crate) fn exact_curves(&self) -> bool {
        self.sampled.is_none() || self.exact_too
    }
}

pm_registry::choices! {
    /// Which lines a record touches that does not lie in one.
    #[derive(Debug, Default)]
    pub enum SpanRule {
        /// Every line it has a byte in
        #[default]
        Both = "both",
        /// The line of its first byte, as simulators of single addresses count
        First = "first",
        /// Every line it has a byte in, but a record counts once, and its misses as one: as cachegrind counts
        Once = "once",
    }
}
