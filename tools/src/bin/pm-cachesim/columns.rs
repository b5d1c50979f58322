//! Columns of the results: what each is called, whether the table shows it, and its value.

use pm_tools::cache::{CacheConfig, Curve, Distribution, Estimate, Row, SampledCurve, TraceCounts, Ways, WorkingSets};
use pm_tools::report::{Column, Format, Table, Value};
use std::collections::BTreeSet;
use std::rc::Rc;

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

    /// A count that there may not be, not in the table.
    fn count_perhaps(self, name: &str, value: impl Fn(&T) -> Option<u64> + 'static) -> Self {
        self.number(name, false, move |of| perhaps(value(of)))
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
    /// Searches in flight at a time.
    pub(crate) lanes: u16,
    pub(crate) row: Row,
    /// The commands that the trace came by.
    pub(crate) history: Rc<str>,
    /// Names of the regions of the trace.
    pub(crate) regions: Rc<Vec<String>>,
    /// Bytes of queries spilled to memory and read back by the stages before.
    pub(crate) query_bytes: u64,
    /// Bytes on chip that the stages before needed to order the queries.
    pub(crate) order_bytes: u64,
    /// Bytes read and written for results, if they were counted.
    pub(crate) result_bytes: Option<u64>,
}

impl CacheResult {
    /// Map, queries and results together.
    fn total_bytes(&self) -> Option<u64> {
        Some(self.row.traffic_bytes().saturating_add(self.query_bytes).saturating_add(self.result_bytes?))
    }

    /// Fetches of all regions whose name in a column is this.
    fn region_fetches(&self, name: &str) -> u64 {
        let named = self.regions.iter().zip(&self.row.region_fetches).filter(|(region, _)| column_name(region) == name);
        named.map(|(_, fetches)| fetches).sum()
    }

    fn sets(&self, of: SetsOf) -> Option<&Distribution> {
        self.row.more.working_sets.as_deref().map(of)
    }
}

/// The working sets of searches, or those of batches.
type SetsOf = fn(&WorkingSets) -> &Distribution;

/// A count that there may not be.
fn perhaps(count: Option<u64>) -> Value {
    count.map_or(Value::Float(f64::NAN, DIGITS), Value::Int)
}

/// A region's name as part of a column's: `split planes` is `split_planes`.
fn column_name(region: &str) -> String {
    region.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect()
}

/// The table of simulated caches.
pub(crate) fn of_caches(format: Format, results: &[CacheResult]) -> Table {
    // Where all traces are read one search after the other there is nothing to say.
    let lanes = results.iter().any(|of| of.lanes > 1);
    let mut columns = Columns(vec![])
        .text("order", true, |of: &CacheResult| of.order.clone())
        .text("cache", true, |of| of.row.config.to_string())
        .count("lanes", lanes, |of| of.lanes.into())
        .count("cache_bytes", false, |of| of.row.config.size_bytes())
        .text("ways", false, |of| of.row.config.ways().to_string())
        .count("line_bytes", false, |of| of.row.config.line_bytes().into())
        .text("policy", false, |of| of.row.config.policy().to_string())
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
        .number("capacity", false, |of| perhaps(of.row.capacity()))
        .number("conflict", false, |of| of.row.conflict().map_or(perhaps(None), Value::Signed))
        .number("page_switches", false, |of| perhaps(of.row.more.page_switches))
        .ratio("page_switches_per_fetch", false, |of| of.row.page_switches_per_fetch().unwrap_or(f64::NAN));
    let of_searches: SetsOf = |sets| &sets.per_search;
    let of_batches: SetsOf = |sets| &sets.per_batch;
    for (name, of) in [("search", of_searches), ("batch", of_batches)] {
        let percentile = |percent| move |result: &CacheResult| result.sets(of)?.percentile(percent).map(u64::from);
        columns = columns
            .count_perhaps(&format!("{name}es"), move |result| Some(result.sets(of)?.number()))
            .ratio(&format!("lines_per_{name}_mean"), false, move |r| r.sets(of).map_or(f64::NAN, Distribution::mean))
            .count_perhaps(&format!("lines_per_{name}_p50"), percentile(50))
            .count_perhaps(&format!("lines_per_{name}_p90"), percentile(90))
            .count_perhaps(&format!("lines_per_{name}_max"), move |result| result.sets(of)?.max().map(u64::from));
    }
    columns = columns
        .count_perhaps("batch_floor", move |of| Some(of.sets(of_batches)?.sum()))
        .count("query_bytes", false, |of| of.query_bytes)
        .number("result_bytes", false, |of| perhaps(of.result_bytes))
        .number("total_bytes", false, |of| perhaps(of.total_bytes()))
        .count("order_bytes_on_chip", false, |of| of.order_bytes);
    let regions: BTreeSet<String> =
        results.iter().flat_map(|of| of.regions.iter().map(|name| column_name(name))).collect();
    for region in regions {
        let name = format!("fetches_{region}");
        // A region called `per_query` would be another column.
        if columns.0.iter().all(|of| of.column.name != name) {
            columns = columns.count(&name, false, move |of| of.region_fetches(&region));
        }
    }
    columns.text("history", false, |of| of.history.to_string()).table(format, results)
}

/// One size of a curve: exact, from a sample of the lines, or both.
#[derive(Clone)]
pub(crate) struct CurvePoint {
    /// The order of the queries.
    pub(crate) order: String,
    /// Searches in flight at a time.
    pub(crate) lanes: u16,
    /// The commands that the trace came by.
    pub(crate) history: Rc<str>,
    pub(crate) exact: Option<Rc<Curve>>,
    pub(crate) sampled: Option<Rc<SampledCurve>>,
    pub(crate) trace: TraceCounts,
    /// The size in lines.
    pub(crate) lines: u64,
}

impl CurvePoint {
    /// The cache, as `--cache` would have it.
    fn cache(&self) -> String {
        let config = CacheConfig::lru(self.bytes(), Ways::Full, self.trace.line_bytes);
        config.map_or_else(|error| error.to_string(), |config| config.to_string())
    }

    fn bytes(&self) -> u64 {
        self.bytes_of(self.lines)
    }

    fn bytes_of(&self, lines: u64) -> u64 {
        lines.saturating_mul(self.trace.line_bytes.into())
    }

    fn fetches(&self) -> Option<u64> {
        Some(self.exact.as_ref()?.fetches(self.lines))
    }

    fn write_backs(&self) -> Option<u64> {
        Some(self.exact.as_ref()?.write_backs(self.lines))
    }

    fn estimate(&self) -> Option<Estimate> {
        self.sampled.as_ref()?.fetches(self.lines)
    }

    /// Fetches, exact if they are known so.
    fn best(&self) -> f64 {
        let exact = self.fetches().map(|fetches| fetches as f64);
        exact.or_else(|| Some(self.estimate()?.fetches)).unwrap_or(f64::NAN)
    }

    fn traffic(&self) -> f64 {
        match (self.fetches(), self.write_backs()) {
            (Some(fetches), Some(written)) => self.bytes_of(fetches + written) as f64,
            _ => f64::NAN,
        }
    }

    /// What is remarkable about the size.
    fn mark(&self) -> &'static str {
        let Some(exact) = &self.exact else { return "" };
        match () {
            () if exact.cliff() == Some(self.lines) => "cliff",
            () if exact.last() == self.lines => "all",
            () => "",
        }
    }
}

/// The table of sizes of curves. Columns of the sample are there if there is one.
pub(crate) fn of_curves(format: Format, points: &[CurvePoint]) -> Table {
    let lanes = points.iter().any(|of| of.lanes > 1);
    let exact = points.iter().any(|of| of.exact.is_some());
    let mut columns = Columns(vec![])
        .text("order", true, |of: &CurvePoint| of.order.clone())
        .text("cache", true, CurvePoint::cache)
        .count("lanes", lanes, |of| of.lanes.into())
        .count("cache_lines", true, |of| of.lines)
        .count("cache_bytes", false, CurvePoint::bytes)
        .count("queries", false, |of| of.trace.queries)
        .count("reads", false, |of| of.trace.records.reads)
        .count("accesses", false, |of| of.trace.accesses);
    if exact {
        columns = columns
            .number("fetches", true, |of| perhaps(of.fetches()))
            .number("bytes_fetched", true, |of| perhaps(of.fetches().map(|lines| of.bytes_of(lines))))
            .count_perhaps("bytes_written_back", |of| of.write_backs().map(|lines| of.bytes_of(lines)))
            .count_perhaps("compulsory", |of| Some(of.exact.as_ref()?.compulsory))
            .count_perhaps("capacity", |of| Some(of.fetches()? - of.exact.as_ref()?.compulsory));
    }
    if points.iter().any(|of| of.sampled.is_some()) {
        let estimate = |of: &CurvePoint, number: fn(Estimate) -> f64| of.estimate().map_or(f64::NAN, number);
        columns = columns
            .ratio("sampled_rate", false, |of| of.sampled.as_ref().map_or(f64::NAN, |curve| curve.rate))
            .ratio("sampled_fetches", true, move |of| estimate(of, |estimate| estimate.fetches))
            .ratio("plus_or_minus", true, move |of| estimate(of, |estimate| estimate.error));
        if exact {
            let off = move |of: &CurvePoint| estimate(of, |estimate| estimate.fetches) / of.best() - 1.0;
            columns = columns.ratio("sampled_off", true, off);
        }
    }
    columns = columns
        .count("blocks", false, |of| of.trace.blocks)
        .ratio("fetches_per_query", true, |of| of.best() / of.trace.queries as f64)
        .ratio("fetches_per_block", true, |of| of.best() / of.trace.blocks as f64);
    if exact {
        columns = columns.ratio("bytes_per_query", false, |of| of.traffic() / of.trace.queries as f64).text(
            "mark",
            true,
            |of| of.mark().to_owned(),
        );
    }
    columns.text("history", false, |of| of.history.to_string()).table(format, points)
}
