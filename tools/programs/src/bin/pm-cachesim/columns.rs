//! Columns of the results: what each is called, whether the table shows it, and its value.

use super::found::Found;
use pm_caches::{
    CacheConfig, Counts, Curve, Distribution, Estimate, Row, SampledCurve, TraceCounts, Ways, WorkingSets,
};
use pm_report::{Column, Format, Table, Value};
use std::collections::BTreeSet;
use std::rc::Rc;

/// Significant digits of ratios in the table.
const DIGITS: u8 = 5;

/// A column of results of type `T`.
struct Of<T> {
    column: Column,
    in_table: bool,
    /// What the table calls it, if not by its name.
    head: Option<&'static str>,
    value: Box<dyn Fn(&T) -> Value>,
}

/// Columns in order.
struct Columns<T>(Vec<Of<T>>);

impl<T> Columns<T> {
    fn text(mut self, name: &str, in_table: bool, value: impl Fn(&T) -> String + 'static) -> Self {
        let value = Box::new(move |of: &T| Value::Text(value(of)));
        self.0.push(Of { column: Column::text(name), in_table, head: None, value });
        self
    }

    fn number(mut self, name: &str, in_table: bool, value: impl Fn(&T) -> Value + 'static) -> Self {
        self.0.push(Of { column: Column::number(name), in_table, head: None, value: Box::new(value) });
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

    /// The table has the last column too.
    fn in_table(mut self) -> Self {
        if let Some(last) = self.0.last_mut() {
            last.in_table = true;
        }
        self
    }

    /// The last column has another name in the table.
    fn headed(mut self, head: &'static str) -> Self {
        if let Some(last) = self.0.last_mut() {
            last.head = Some(head);
        }
        self
    }

    /// The table of these results, with the columns that the format shows.
    fn table(self, format: Format, results: &[T]) -> Table {
        let shown: Vec<Of<T>> = self.0.into_iter().filter(|of| of.in_table || format != Format::Table).collect();
        let head = |of: &Of<T>| match of.head {
            Some(name) if format == Format::Table => Column { name: name.to_owned(), ..of.column.clone() },
            _ => of.column.clone(),
        };
        let mut table = Table::new(shown.iter().map(head).collect());
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
    /// Which part of the stream the trace is of, in words; empty if it is of all.
    pub(crate) sample: String,
    /// Searches in flight at a time.
    pub(crate) lanes: u16,
    pub(crate) found: Found,
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
    /// The exact counts, if there are such of the whole trace.
    fn row(&self) -> Option<&Row> {
        match &self.found {
            Found::Exact(row) => Some(row),
            Found::Windows(_) => None,
        }
    }

    /// Map, queries and results together.
    fn total_bytes(&self) -> Option<u64> {
        Some(self.row()?.traffic_bytes().saturating_add(self.query_bytes).saturating_add(self.result_bytes?))
    }

    /// Adds up numbers of the regions whose name in a column is this.
    fn of_regions(&self, name: &str) -> impl Fn(&[u64]) -> u64 + use<> {
        let named: Vec<bool> = self.regions.iter().map(|region| column_name(region) == name).collect();
        move |numbers| named.iter().zip(numbers).map(|(named, number)| u64::from(*named) * number).sum()
    }

    fn sets(&self, of: SetsOf) -> Option<&Distribution> {
        self.row()?.more.working_sets.as_deref().map(of)
    }

    fn config(&self) -> &CacheConfig {
        self.found.config()
    }

    /// Half the width of an interval; of a whole stream there is nothing to estimate, and a sample that is not one of
    /// windows does not tell.
    fn half_width(&self, estimated: f64) -> f64 {
        match &self.found {
            Found::Windows(_) => estimated,
            Found::Exact(_) if self.sample.is_empty() => 0.0,
            Found::Exact(_) => f64::NAN,
        }
    }
}

/// How much of a window's count may as well be nothing.
type Unknown = fn(&CacheResult) -> Box<dyn Fn(&Counts) -> u64>;

/// What does not depend on what is cached.
const NONE: Unknown = |_| Box::new(|_| 0);
/// Fetches.
const FETCHES: Unknown = |_| Box::new(Counts::unknown_fetches);
/// Bytes of fetches.
const BYTES: Unknown = |of| {
    let line = u64::from(of.config().line_bytes());
    Box::new(move |counts| counts.unknown_fetches() * line)
};

/// Columns of caches.
impl Columns<CacheResult> {
    /// A count of the stream, or an estimate of it.
    fn total(self, name: &str, in_table: bool, count: fn(&Row) -> u64) -> Self {
        self.number(name, in_table, move |of| of.found.total(count, NONE(of)).0)
    }

    /// The same with half the width of its interval behind it.
    fn total_with_error(self, name: &str, in_table: bool, count: fn(&Row) -> u64, unknown: Unknown) -> Self {
        self.number(name, in_table, move |of| of.found.total(count, unknown(of)).0).ratio(
            &format!("{name}_error"),
            false,
            move |of| of.half_width(of.found.total(count, unknown(of)).1),
        )
    }

    /// A count for each query, with half the width of its interval behind it.
    fn per_query(self, name: &str, in_table: bool, count: fn(&Row) -> u64, unknown: Unknown) -> Self {
        self.ratio(name, in_table, move |of| of.found.per_query(count, unknown(of)).value).ratio(
            &format!("{name}_error"),
            false,
            move |of| of.half_width(of.found.per_query(count, unknown(of)).half_width()),
        )
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
    let sampled = results.iter().any(|of| !of.sample.is_empty());
    let windowed = results.iter().any(|of| of.row().is_none());
    let mut columns = Columns(vec![])
        .text("order", true, |of: &CacheResult| of.order.clone())
        .text("sample", sampled, |of| of.sample.clone())
        .text("cache", true, |of| of.config().to_string())
        .count("lanes", lanes, |of| of.lanes.into())
        .count("cache_bytes", false, |of| of.config().size_bytes())
        .text("ways", false, |of| of.config().ways().to_string())
        .count("line_bytes", false, |of| of.config().line_bytes().into())
        .text("policy", false, |of| of.config().policy().to_string())
        .total("queries", !windowed, |row| row.queries)
        .total("reads", false, |row| row.records.reads)
        .total("raw_bytes", false, Row::raw_bytes)
        .total("accesses", false, |row| row.accesses)
        .total_with_error("fetches", !windowed, |row| row.fetches, FETCHES)
        .total_with_error("bytes_fetched", true, |row| row.bytes_fetched, BYTES)
        .number("bytes_written_back", false, |of| match of.found.knows_write_backs() {
            true => of.found.total(|row| row.bytes_written_back, |_| 0).0,
            false => perhaps(None),
        })
        .count_perhaps("compulsory", |of| Some(of.row()?.compulsory))
        .count("blocks", false, |of| of.found.blocks())
        .per_query("reads_per_query", true, |row| row.records.reads, NONE)
        .per_query("accesses_per_query", false, |row| row.accesses, NONE)
        .per_query("fetches_per_query", true, |row| row.fetches, FETCHES);
    if windowed {
        columns = columns.in_table().headed("±");
    }
    columns = columns
        .ratio("fetches_per_query_doubt", false, |of| of.half_width(of.found.fetches_per_query().doubt))
        .ratio("degrees_of_freedom", false, |of| of.found.fetches_per_query().spread.freedom)
        .ratio("fetches_per_block", true, |of| of.found.fetches_per_block().value)
        .ratio("fetches_per_block_error", false, |of| of.half_width(of.found.fetches_per_block().half_width()))
        .ratio("bytes_per_query", false, |of| of.found.bytes_per_query(BYTES(of)).value)
        .ratio("bytes_per_query_error", false, |of| of.half_width(of.found.bytes_per_query(BYTES(of)).half_width()))
        .number("capacity", false, |of| perhaps(of.row().and_then(Row::capacity)))
        .number("conflict", false, |of| of.row().and_then(Row::conflict).map_or(perhaps(None), Value::Signed))
        .number("page_switches", false, |of| of.found.page_switches())
        .ratio("page_switches_per_fetch", false, |of| of.found.page_switches_per_fetch());
    let of_searches: SetsOf = |sets| &sets.per_search;
    let of_batches: SetsOf = |sets| &sets.per_batch;
    for (name, of) in [("search", of_searches), ("batch", of_batches)] {
        let percentile = |percent| move |result: &CacheResult| result.sets(of)?.percentile(percent).map(u64::from);
        let mean = move |result: &CacheResult| match name {
            "search" => result.found.lines_per_search(),
            _ => result.sets(of).map_or(f64::NAN, Distribution::mean),
        };
        columns = columns
            .count_perhaps(&format!("{name}es"), move |result| Some(result.sets(of)?.number()))
            .ratio(&format!("lines_per_{name}_mean"), false, mean)
            .count_perhaps(&format!("lines_per_{name}_p50"), percentile(50))
            .count_perhaps(&format!("lines_per_{name}_p90"), percentile(90))
            .count_perhaps(&format!("lines_per_{name}_max"), move |result| result.sets(of)?.max().map(u64::from));
    }
    columns = columns
        .count_perhaps("batch_floor", move |of| Some(of.sets(of_batches)?.sum()))
        // What was spilled of a sample is not what would be of all.
        .count_perhaps("query_bytes", |of| of.row().map(|_| of.query_bytes))
        .number("result_bytes", false, |of| perhaps(of.result_bytes))
        .number("total_bytes", false, |of| perhaps(of.total_bytes()))
        .count("order_bytes_on_chip", false, |of| of.order_bytes)
        .count("windows", windowed, |of| of.found.windows().map_or(0, |windows| windows.counts.len() as u64))
        .count("windows_inexact", windowed, |of| of.found.windows().map_or(0, |windows| windows.windows_inexact()))
        .count("queries_measured", false, |of| of.found.queries_measured())
        .count("queries_simulated", windowed, |of| of.found.queries_simulated())
        .ratio("sample_share", false, |of| match of.found.windows() {
            Some(windows) => windows.share.unwrap_or(f64::NAN),
            None if of.sample.is_empty() => 1.0,
            None => f64::NAN,
        });
    let regions: BTreeSet<String> =
        results.iter().flat_map(|of| of.regions.iter().map(|name| column_name(name))).collect();
    for region in regions {
        let names = [format!("fetches_{region}"), format!("fetches_{region}_error")];
        // A region called `per_query` would be another column.
        if columns.0.iter().all(|of| !names.contains(&of.column.name)) {
            let total = move |of: &CacheResult| {
                let sum = of.of_regions(&region);
                of.found.total(|row| sum(&row.region_fetches), |counts| sum(&counts.unknown))
            };
            let again = total.clone();
            columns = columns
                .number(&names[0], false, move |of| total(of).0)
                .ratio(&names[1], false, move |of| of.half_width(again(of).1));
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
