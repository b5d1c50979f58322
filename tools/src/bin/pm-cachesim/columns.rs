//! Columns of the results: what each is called, whether the table shows it, and its value.

use pm_tools::cache::{CacheConfig, Curve, Row, Ways};
use pm_tools::report::{Column, Format, Table, Value};

/// Significant digits of ratios in the table.
const DIGITS: u8 = 5;

/// A column of results of type `T`.
struct Of<T> {
    column: Column,
    in_table: bool,
    value: Box<dyn Fn(&T) -> Value>,
}

/// Columns in order.
struct Columns<T>(Vec<Of<T>>);

impl<T> Columns<T> {
    fn text(mut self, name: &str, in_table: bool, value: impl Fn(&T) -> String + 'static) -> Self {
        let value = Box::new(move |of: &T| Value::Text(value(of)));
        self.0.push(Of { column: Column::text(name), in_table, value });
        self
    }

    fn number(mut self, name: &str, in_table: bool, value: impl Fn(&T) -> Value + 'static) -> Self {
        self.0.push(Of { column: Column::number(name), in_table, value: Box::new(value) });
        self
    }

    fn count(self, name: &str, in_table: bool, value: impl Fn(&T) -> u64 + 'static) -> Self {
        self.number(name, in_table, move |of| Value::Int(value(of)))
    }

    fn ratio(self, name: &str, in_table: bool, value: impl Fn(&T) -> f64 + 'static) -> Self {
        self.number(name, in_table, move |of| Value::Float(value(of), DIGITS))
    }

    /// The table of these results, with the columns that the format shows.
    fn table(self, format: Format, results: &[T]) -> Table {
        let shown: Vec<Of<T>> = self.0.into_iter().filter(|of| of.in_table || format != Format::Table).collect();
        let mut table = Table::new(shown.iter().map(|of| of.column.clone()).collect());
        for result in results {
            table.push(shown.iter().map(|of| (of.value)(result)).collect());
        }
        table
    }
}

/// What came of one cache and one trace.
pub(crate) struct CacheResult {
    /// The order of the queries.
    pub(crate) order: String,
    pub(crate) row: Row,
}

/// The table of simulated caches.
pub(crate) fn of_caches(format: Format, results: &[CacheResult]) -> Table {
    Columns(vec![])
        .text("order", true, |of: &CacheResult| of.order.clone())
        .text("cache", true, |of| of.row.config.to_string())
        .count("queries", true, |of| of.row.queries)
        .count("reads", false, |of| of.row.records.reads)
        .count("raw_bytes", false, |of| of.row.raw_bytes())
        .count("accesses", false, |of| of.row.accesses)
        .count("fetches", true, |of| of.row.fetches)
        .count("bytes_fetched", true, |of| of.row.bytes_fetched)
        .count("bytes_written_back", false, |of| of.row.bytes_written_back)
        .count("compulsory", false, |of| of.row.compulsory)
        .count("blocks", false, |of| of.row.blocks)
        .ratio("reads_per_query", true, |of| of.row.reads_per_query())
        .ratio("fetches_per_query", true, |of| of.row.fetches_per_query())
        .ratio("fetches_per_block", true, |of| of.row.fetches_per_block())
        .ratio("bytes_per_query", false, |of| of.row.bytes_per_query())
        .table(format, results)
}

/// One size of a curve.
pub(crate) struct CurvePoint {
    /// The order of the queries.
    pub(crate) order: String,
    pub(crate) curve: std::rc::Rc<Curve>,
    /// The size in lines.
    pub(crate) lines: u64,
}

impl CurvePoint {
    /// The cache, as `--cache` would have it.
    fn cache(&self) -> String {
        let line = self.curve.trace.line_bytes;
        let config = CacheConfig::lru(self.bytes(), Ways::Full, line);
        config.map_or_else(|error| error.to_string(), |config| config.to_string())
    }

    fn bytes(&self) -> u64 {
        self.curve.bytes(self.lines).unwrap_or(u64::MAX)
    }

    fn fetches(&self) -> u64 {
        self.curve.fetches(self.lines)
    }

    fn bytes_of(&self, lines: u64) -> u64 {
        lines * u64::from(self.curve.trace.line_bytes)
    }

    fn traffic(&self) -> u64 {
        self.bytes_of(self.fetches() + self.curve.write_backs(self.lines))
    }

    /// What is remarkable about the size.
    fn mark(&self) -> &'static str {
        match () {
            () if self.curve.cliff() == Some(self.lines) => "cliff",
            () if self.curve.last() == self.lines => "all",
            () => "",
        }
    }
}

/// The table of sizes of curves.
pub(crate) fn of_curves(format: Format, points: &[CurvePoint]) -> Table {
    let queries = |of: &CurvePoint| of.curve.trace.queries;
    let per_query = move |count: u64, of: &CurvePoint| count as f64 / queries(of) as f64;
    Columns(vec![])
        .text("order", true, |of: &CurvePoint| of.order.clone())
        .text("cache", true, CurvePoint::cache)
        .count("cache_lines", true, |of| of.lines)
        .count("cache_bytes", false, CurvePoint::bytes)
        .count("queries", false, queries)
        .count("reads", false, |of| of.curve.trace.records.reads)
        .count("accesses", false, |of| of.curve.trace.accesses)
        .count("fetches", true, CurvePoint::fetches)
        .count("bytes_fetched", true, |of| of.bytes_of(of.fetches()))
        .count("bytes_written_back", false, |of| of.bytes_of(of.curve.write_backs(of.lines)))
        .count("compulsory", false, |of| of.curve.compulsory)
        .count("capacity", false, |of| of.fetches() - of.curve.compulsory)
        .count("blocks", false, |of| of.curve.trace.blocks)
        .ratio("fetches_per_query", true, |of| of.curve.fetches_per_query(of.lines))
        .ratio("fetches_per_block", true, |of| of.curve.fetches_per_block(of.lines))
        .ratio("bytes_per_query", false, move |of| per_query(of.traffic(), of))
        .text("mark", true, |of| of.mark().to_owned())
        .table(format, points)
}
