//! What was found of a cache: exact counts of a whole trace, or estimates from windows.

use pm_caches::{CacheConfig, CacheCounts, WindowCounts, WindowedCounts};
use pm_report::Value;
use pm_sampling::{Ratio, Spread};

/// Significant digits of estimated counts in the table.
const DIGITS: u8 = 5;

/// What was found of one cache.
pub(super) enum Found {
    /// Counts of the trace as it is.
    Exact(Box<CacheCounts>),
    /// Estimates of the stream that the trace has windows of.
    Windows(WindowedCounts),
}

impl Found {
    pub(super) fn config(&self) -> &CacheConfig {
        match self {
            Self::Exact(counts) => &counts.config,
            Self::Windows(counts) => &counts.config,
        }
    }

    pub(super) fn blocks(&self) -> u64 {
        match self {
            Self::Exact(counts) => counts.blocks,
            Self::Windows(counts) => counts.blocks,
        }
    }

    pub(super) fn windows(&self) -> Option<&WindowedCounts> {
        match self {
            Self::Exact(_) => None,
            Self::Windows(counts) => Some(counts),
        }
    }

    /// A count of the whole stream, and half the width of its interval.
    pub(super) fn total(
        &self,
        count: impl Fn(&CacheCounts) -> u64,
        unknown: impl Fn(&WindowCounts) -> u64,
    ) -> (Value, f64) {
        match self {
            Self::Exact(counts) => (Value::Int(count(counts)), 0.0),
            Self::Windows(counts) => {
                let total = counts.total(|window| count(&window.cache), unknown);
                (rounded(total.value), total.half_width())
            }
        }
    }

    /// A count for each query.
    pub(super) fn per_query(
        &self,
        count: impl Fn(&CacheCounts) -> u64,
        unknown: impl Fn(&WindowCounts) -> u64,
    ) -> Ratio {
        match self {
            Self::Exact(counts) => known(count(counts) as f64 / counts.queries as f64),
            Self::Windows(counts) => {
                counts.ratio(|window| count(&window.cache), unknown, |window| window.cache.queries)
            }
        }
    }

    /// Fetches for each query.
    pub(super) fn fetches_per_query(&self) -> Ratio {
        self.per_query(|of| of.fetches, WindowCounts::unknown_fetches)
    }

    /// Bytes to and from memory for each query; none where write-backs cannot be told.
    pub(super) fn bytes_per_query(&self, unknown: impl Fn(&WindowCounts) -> u64) -> Ratio {
        let bytes = self.per_query(CacheCounts::traffic_bytes, unknown);
        if self.knows_write_backs() { bytes } else { Ratio { value: f64::NAN, doubt: f64::NAN, ..bytes } }
    }

    /// Fetches of the whole stream for each block.
    pub(super) fn fetches_per_block(&self) -> Ratio {
        match self {
            Self::Exact(counts) => known(counts.fetches_per_block()),
            Self::Windows(counts) => {
                let total = counts.total(|window| window.cache.fetches, WindowCounts::unknown_fetches);
                let (a_block, value) = (1.0 / counts.blocks as f64, total.value / counts.blocks as f64);
                Ratio { value, spread: total.spread.scaled(a_block), doubt: total.doubt * a_block, ..total }
            }
        }
    }

    /// Whether write-backs can be told: a window does not know which of its lines are dirty from before.
    pub(super) fn knows_write_backs(&self) -> bool {
        self.windows().is_none_or(|counts| {
            !counts.config.keeps_lines() || counts.windows.iter().all(|window| window.cache.bytes_written_back == 0)
        })
    }

    pub(super) fn page_switches(&self) -> Value {
        match self {
            Self::Exact(counts) => counts.more.page_switches.map_or(NOTHING, Value::Int),
            Self::Windows(counts) => rounded(counts.total(switches, |_| 0).value),
        }
    }

    pub(super) fn page_switches_per_fetch(&self) -> f64 {
        match self {
            Self::Exact(counts) => counts.page_switches_per_fetch().unwrap_or(f64::NAN),
            Self::Windows(counts) => counts.ratio(switches, |_| 0, |window| window.cache.fetches).value,
        }
    }

    /// Distinct lines of a search, on average.
    pub(super) fn lines_per_search(&self) -> f64 {
        match self {
            Self::Exact(counts) => counts.more.working_sets.as_ref().map_or(f64::NAN, |sets| sets.per_search.mean()),
            Self::Windows(counts) => {
                counts.ratio(|window| window.search_lines.unwrap_or(0), |_| 0, |window| window.cache.searches).value
            }
        }
    }

    pub(super) fn queries_measured(&self) -> u64 {
        match self {
            Self::Exact(counts) => counts.queries,
            Self::Windows(counts) => counts.queries_measured(),
        }
    }

    pub(super) fn queries_simulated(&self) -> u64 {
        match self {
            Self::Exact(counts) => counts.queries,
            Self::Windows(counts) => counts.queries_simulated,
        }
    }
}

/// Changes of the DRAM page in a window.
fn switches(window: &WindowCounts) -> u64 {
    window.cache.more.page_switches.unwrap_or(0)
}

/// A number that nothing is estimated of.
fn known(value: f64) -> Ratio {
    Ratio { value, weight: 1.0, spread: Spread { variance: 0.0, freedom: f64::NAN }, doubt: 0.0 }
}

/// No such count.
const NOTHING: Value = Value::Float(f64::NAN, DIGITS);

/// An estimated count, to the nearest whole.
fn rounded(count: f64) -> Value {
    if count.is_finite() { Value::Int(count.round() as u64) } else { NOTHING }
}
