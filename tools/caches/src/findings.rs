//! What there is to find out of a trace and its caches, and what was found.

mod counts;
mod distribution;
mod measures;
mod record_counts;
mod result_traffic;
#[cfg(test)]
mod tests;
mod trace_counts;
mod working_sets;

pub use counts::{AskedCounts, CacheCounts};
pub use distribution::Distribution;
pub use measures::{Measures, SpanRule};
pub use record_counts::RecordCounts;
pub(crate) use result_traffic::ResultTraffic;
pub use result_traffic::{ResultMemory, SECTOR_BYTES};
pub use trace_counts::TraceCounts;
pub(crate) use working_sets::WorkingSetCounter;
pub use working_sets::WorkingSets;

use crate::{Curve, SampledCurve};

/// All that a simulation found.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// The counts of each cache, in the order they were given.
    pub caches: Vec<CacheCounts>,
    /// One curve for each line size, in the order they were given.
    pub curves: Vec<Curve>,
    /// One curve for each line size from a sample of the lines, if that was asked for.
    pub sampled: Vec<SampledCurve>,
    /// Bytes read and written for results, if that was asked for.
    pub result_bytes: Option<u64>,
}
