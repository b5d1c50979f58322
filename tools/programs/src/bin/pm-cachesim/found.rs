//! What was found of a cache: exact counts of a whole trace, or estimates from windows.

use pm_caches::{CacheConfig, Counts, Policy, Row, WindowedRow};
use pm_report::Value;
use pm_sampling::{Ratio, Spread};

/// Significant digits of estimated counts in the table.
const DIGITS: u8 = 5;

/// What was found of one cache.
pub(crate) enum Found {
    /// Counts of the trace as it is.
    Exact(Row),
    /// Estimates of the stream that the trace has windows of.
    Windows(WindowedRow),
}

impl Found {
    pub(crate) fn config(&self) -> &CacheConfig {
        match self {
            Self::Exact(row) => &row.config,
            Self::Windows(row) => &row.config,
        }
    }

    pub(crate) fn blocks(&self) -> u64 {
        match self {
            Self::Exact(row) => row.blocks,
            Self::Windows(row) => row.blocks,
        }
    }

    pub(crate) fn windows(&self) -> Option<&WindowedRow> {
        match self {
            Self::Exact(_) => None,
            Self::Windows(row) => Some(row),
        }
    }

    /// A count of the whole stream, and half the width of its interval.
    pub(crate) fn total(&self, count: impl Fn(&Row) -> u64, unknown: impl Fn(&Counts) -> u64) -> (Value, f64) {
        match self {
            Self::Exact(row) => (Value::Int(count(row)), 0.0),
            Self::Windows(row) => {
                let total = row.total(|counts| count(&counts.row), unknown);
                (rounded(total.value), total.half_width())
            }
        }
    }

    /// A count for each query.
    pub(crate) fn per_query(&self, count: impl Fn(&Row) -> u64, unknown: impl Fn(&Counts) -> u64) -> Ratio {
        match self {
            Self::Exact(row) => known(count(row) as f64 / row.queries as f64),
            Self::Windows(row) => row.ratio(|counts| count(&counts.row), unknown, |counts| counts.row.queries),
        }
    }

    /// Fetches for each query.
    pub(crate) fn fetches_per_query(&self) -> Ratio {
        self.per_query(|row| row.fetches, Counts::unknown_fetches)
    }

    /// Bytes to and from memory for each query; none where write-backs cannot be told.
    pub(crate) fn bytes_per_query(&self, unknown: impl Fn(&Counts) -> u64) -> Ratio {
        let bytes = self.per_query(Row::traffic_bytes, unknown);
        if self.knows_write_backs() { bytes } else { Ratio { value: f64::NAN, doubt: f64::NAN, ..bytes } }
    }

    /// Fetches of the whole stream for each block.
    pub(crate) fn fetches_per_block(&self) -> Ratio {
        match self {
            Self::Exact(row) => known(row.fetches_per_block()),
            Self::Windows(row) => {
                let total = row.total(|counts| counts.row.fetches, Counts::unknown_fetches);
                let (a_block, value) = (1.0 / row.blocks as f64, total.value / row.blocks as f64);
                Ratio { value, spread: total.spread.scaled(a_block), doubt: total.doubt * a_block, ..total }
            }
        }
    }

    /// Whether write-backs can be told: a window does not know which of its lines are dirty from before.
    pub(crate) fn knows_write_backs(&self) -> bool {
        self.windows().is_none_or(|row| {
            row.config.policy() == Policy::None || row.counts.iter().all(|counts| counts.row.bytes_written_back == 0)
        })
    }

    pub(crate) fn page_switches(&self) -> Value {
        match self {
            Self::Exact(row) => row.more.page_switches.map_or(NOTHING, Value::Int),
            Self::Windows(row) => rounded(row.total(switches, |_| 0).value),
        }
    }

    pub(crate) fn page_switches_per_fetch(&self) -> f64 {
        match self {
            Self::Exact(row) => row.page_switches_per_fetch().unwrap_or(f64::NAN),
            Self::Windows(row) => row.ratio(switches, |_| 0, |counts| counts.row.fetches).value,
        }
    }

    /// Distinct lines of a search, on average.
    pub(crate) fn lines_per_search(&self) -> f64 {
        match self {
            Self::Exact(row) => row.more.working_sets.as_ref().map_or(f64::NAN, |sets| sets.per_search.mean()),
            Self::Windows(row) => {
                row.ratio(|counts| counts.search_lines.unwrap_or(0), |_| 0, |counts| counts.row.searches).value
            }
        }
    }

    pub(crate) fn queries_measured(&self) -> u64 {
        match self {
            Self::Exact(row) => row.queries,
            Self::Windows(row) => row.queries_measured(),
        }
    }

    pub(crate) fn queries_simulated(&self) -> u64 {
        match self {
            Self::Exact(row) => row.queries,
            Self::Windows(row) => row.queries_simulated,
        }
    }
}

/// Changes of the DRAM page in a window.
fn switches(counts: &Counts) -> u64 {
    counts.row.more.page_switches.unwrap_or(0)
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
