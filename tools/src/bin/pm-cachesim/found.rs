//! What was found of a cache: exact counts of a whole trace, or estimates from windows.

use pm_tools::cache::{CacheConfig, Row, WindowedRow};
use pm_tools::report::Value;

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
    pub(crate) fn total(&self, count: impl Fn(&Row) -> u64) -> (Value, f64) {
        match self {
            Self::Exact(row) => (Value::Int(count(row)), 0.0),
            Self::Windows(row) => {
                let total = row.total(|counts| count(&counts.row));
                (rounded(total.value), total.half_width)
            }
        }
    }

    /// A count for each query, and half the width of its interval.
    pub(crate) fn per_query(&self, count: impl Fn(&Row) -> u64) -> (f64, f64) {
        match self {
            Self::Exact(row) => (count(row) as f64 / row.queries as f64, 0.0),
            Self::Windows(row) => {
                let ratio = row.per_query(|counts| count(&counts.row));
                (ratio.value, ratio.half_width)
            }
        }
    }

    /// Fetches of the whole stream for each block, and half the width of the interval.
    pub(crate) fn fetches_per_block(&self) -> (f64, f64) {
        match self {
            Self::Exact(row) => (row.fetches_per_block(), 0.0),
            Self::Windows(row) => {
                let (total, blocks) = (row.total(|counts| counts.row.fetches), row.blocks as f64);
                (total.value / blocks, total.half_width / blocks)
            }
        }
    }

    pub(crate) fn page_switches(&self) -> Value {
        match self {
            Self::Exact(row) => row.more.page_switches.map_or(NOTHING, Value::Int),
            Self::Windows(row) => rounded(row.total(|counts| counts.row.more.page_switches.unwrap_or(0)).value),
        }
    }

    pub(crate) fn page_switches_per_fetch(&self) -> f64 {
        match self {
            Self::Exact(row) => row.page_switches_per_fetch().unwrap_or(f64::NAN),
            Self::Windows(row) => {
                row.ratio(|counts| counts.row.more.page_switches.unwrap_or(0), |counts| counts.row.fetches).value
            }
        }
    }

    /// Distinct lines of a search, on average.
    pub(crate) fn lines_per_search(&self) -> f64 {
        match self {
            Self::Exact(row) => row.more.working_sets.as_ref().map_or(f64::NAN, |sets| sets.per_search.mean()),
            Self::Windows(row) => {
                row.ratio(|counts| counts.search_lines.unwrap_or(0), |counts| counts.row.searches).value
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

    /// Degrees of freedom of the interval of fetches per query.
    pub(crate) fn degrees_of_freedom(&self) -> f64 {
        self.windows()
            .map_or(f64::NAN, |row| row.ratio(|counts| counts.row.fetches, |counts| counts.row.queries).spread.freedom)
    }
}

/// No such count.
const NOTHING: Value = Value::Float(f64::NAN, DIGITS);

/// An estimated count, to the nearest whole.
fn rounded(count: f64) -> Value {
    if count.is_finite() { Value::Int(count.round() as u64) } else { NOTHING }
}
