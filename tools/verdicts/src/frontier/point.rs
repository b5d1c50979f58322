//! A point of the frontier: bytes on chip, and bytes of traffic of the whole picture.

use super::Row;

/// Bytes of the cache of results.
const RESULTS: f64 = 16384.0;

/// The columns of the table of points.
pub(super) const COLUMNS: [&str; 14] = [
    "photons",
    "series",
    "record",
    "point",
    "share",
    "found",
    "cache_bytes",
    "order_bytes",
    "on_chip_bytes",
    "map_bytes",
    "query_bytes",
    "result_bytes",
    "total_bytes",
    "best",
];

/// A point.
#[derive(Clone, Debug)]
pub(super) struct Point {
    photons: String,
    pub(super) series: String,
    pub(super) record: String,
    point: String,
    share: String,
    found: String,
    cache: String,
    order: String,
    /// All bytes on chip.
    pub(super) on_chip: f64,
    map: f64,
    queries: f64,
    results: f64,
}

impl Point {
    /// What a row says of the whole image, by the share that was simulated.
    pub(super) fn new(row: &Row, series: &str) -> Self {
        let times = row.times;
        // No line is fetched for the first time twice.
        let first = (row.compulsory * times).min(row.blocks);
        let fetches = (row.fetches - row.compulsory) * times + first;
        Self {
            photons: row.key.photons.clone(),
            series: series.to_owned(),
            record: row.key.record.clone(),
            point: row.key.point.clone().unwrap_or_default(),
            share: row.share.clone(),
            found: row.found.clone(),
            cache: row.cache.clone(),
            order: row.order.clone(),
            on_chip: row.cache_bytes + row.order_bytes + RESULTS,
            map: fetches * row.line_bytes + row.written_back * times,
            queries: row.query_bytes * times,
            results: row.result_bytes * times,
        }
    }

    /// All traffic.
    pub(super) fn traffic(&self) -> f64 {
        self.map + self.queries + self.results
    }

    /// Those that it is compared with: of as many photons, its series, and the same records.
    pub(super) fn group(&self) -> [&str; 3] {
        [&self.photons, &self.series, &self.record]
    }

    /// Its row of the table, with this kind of records.
    pub(super) fn cells(&self, record: &str, best: bool) -> [String; COLUMNS.len()] {
        let bytes = |bytes: f64| format!("{bytes:.0}");
        [
            self.photons.clone(),
            self.series.clone(),
            record.to_owned(),
            self.point.clone(),
            self.share.clone(),
            self.found.clone(),
            self.cache.clone(),
            self.order.clone(),
            bytes(self.on_chip),
            bytes(self.map),
            bytes(self.queries),
            bytes(self.results),
            bytes(self.traffic()),
            if best { "yes" } else { "no" }.to_owned(),
        ]
    }
}
