//! Rows of simulated caches, with the labels of their sweep.

use crate::Table;
use crate::table::Row as Cells;
use pm_report::ReportError;
use pm_report::sheet::number;

/// What a row is of.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    pub(super) photons: String,
    pub(super) series: String,
    pub(super) record: String,
    /// The order with its tile and store; none: any.
    pub(super) point: Option<String>,
}

/// A cache that was simulated.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) key: Key,
    /// As they are written.
    pub(super) share: String,
    pub(super) found: String,
    pub(super) cache: String,
    pub(super) order: String,
    /// How many times as many searches the whole has.
    pub(super) times: f64,
    pub(super) cache_bytes: f64,
    pub(super) order_bytes: f64,
    pub(super) fetches: f64,
    pub(super) compulsory: f64,
    pub(super) blocks: f64,
    pub(super) line_bytes: f64,
    pub(super) written_back: f64,
    pub(super) query_bytes: f64,
    pub(super) result_bytes: f64,
}

impl Row {
    /// Does the cache hold the whole map? Then no line is fetched twice.
    pub(super) fn holds_the_map(&self) -> bool {
        self.fetches == self.compulsory
    }
}

/// The photons of a table that has no such label.
const PAPERS_PHOTONS: &str = "450000";

/// The rows of a table that are of the frontier: searches start with a radius of their own, and the map is a kd-tree.
///
/// # Errors
/// If a column is missing, or a field is not a number.
pub(super) fn read(table: &Table) -> Result<Vec<Row>, ReportError> {
    let is_of_it = |row: &Cells<'_>| {
        row.if_any("start").is_none_or(|start| start == "auto") && row.if_any("map").is_none_or(|map| map == "kd")
    };
    table.rows().filter(is_of_it).map(Row::new).collect()
}

impl Row {
    fn new(row: Cells<'_>) -> Result<Self, ReportError> {
        let share = row.text("share")?;
        let times = number(share.strip_prefix("1/").unwrap_or(share));
        let parts = [row.text("order")?, row.text("tile")?, row.text("store")?];
        let point = parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-");
        Ok(Self {
            key: Key {
                photons: row.if_any("n").unwrap_or(PAPERS_PHOTONS).to_owned(),
                series: row.text("order")?.to_owned(),
                record: row.text("record")?.to_owned(),
                point: Some(point),
            },
            share: share.to_owned(),
            found: row.text("found")?.to_owned(),
            cache: row.text("cache_bytes")?.to_owned(),
            order: row.text("order_bytes_on_chip")?.to_owned(),
            times: times.ok_or_else(|| row.wrong(format!("`{share}` in column share is not such as 1/16")))?,
            cache_bytes: row.number("cache_bytes")?,
            order_bytes: row.number("order_bytes_on_chip")?,
            fetches: row.number("fetches")?,
            compulsory: row.number("compulsory")?,
            blocks: row.number("blocks")?,
            line_bytes: row.number("line_bytes")?,
            written_back: row.number("bytes_written_back")?,
            query_bytes: row.number("query_bytes")?,
            result_bytes: row.number("result_bytes")?,
        })
    }
}
