//! The table of simulated caches.

use super::super::cache_result::{CacheResult, SetsOf, column_name};
use super::totals::{BYTES, FETCHES, NONE};
use super::{Columns, perhaps};
use pm_caches::{CacheCounts, Distribution, PrefetchCounts, PrivateCounts};
use pm_report::{Format, Table, Value};
use std::collections::BTreeSet;

/// The table of simulated caches.
pub(in super::super) fn of_caches(format: Format, results: &[CacheResult]) -> Table {
    let sampled = results.iter().any(|of| !of.sample.is_empty());
    let windowed = results.iter().any(|of| of.counts().is_none());
    // Where all traces are read one search after the other there is nothing to say.
    let lanes = results.iter().any(|of| of.lanes > 1);
    // In the table only where the rest of a row does not tell two apart.
    let names = |of: &CacheResult| (of.order.clone(), of.sample.clone(), of.config().to_string(), of.lanes);
    let same: BTreeSet<_> = results.iter().map(names).collect();
    let traces: BTreeSet<_> = results.iter().map(|of| of.trace.clone()).collect();
    let alike = same.len() < results.len() && traces.len() > 1;
    let maps: BTreeSet<_> = results.iter().map(|of| of.map.clone()).collect();
    let columns = Columns::new()
        .text("trace", alike, |of: &CacheResult| of.trace.to_string())
        .text("map", maps.len() > 1, |of| of.map.to_string())
        .text("order", true, |of| of.order.clone())
        .text("sample", sampled, |of| of.sample.clone())
        .text("cache", true, |of| of.config().to_string())
        .count("lanes", lanes, |of| of.lanes.into())
        .count("cache_bytes", false, |of| of.config().size_bytes())
        .text("ways", false, |of| of.config().ways().to_string())
        .count("line_bytes", false, |of| of.config().line_bytes().into())
        .text("policy", false, |of| of.config().policy().to_string());
    let columns = columns
        .counts(windowed)
        .ratios(windowed)
        .dinero(results)
        .dram(results)
        .miss_chains(results)
        .prefetch(results)
        .private(results)
        .working_sets()
        .other_traffic()
        .windows(windowed);
    columns.fetches_of_regions(results).text("history", false, |of| of.history.to_string()).table(format, results)
}

impl Columns<CacheResult> {
    /// Counts of the stream.
    fn counts(self, windowed: bool) -> Self {
        self.total("queries", !windowed, |counts| counts.queries)
            .total("reads", false, |counts| counts.records.reads)
            .total("raw_bytes", false, CacheCounts::raw_bytes)
            .total("accesses", false, |counts| counts.accesses)
            .total_with_error("fetches", !windowed, |counts| counts.fetches, FETCHES)
            .total_with_error("bytes_fetched", true, |counts| counts.bytes_fetched, BYTES)
            .number("bytes_written_back", false, |of| match of.found.knows_write_backs() {
                true => of.found.total(|counts| counts.bytes_written_back, |_| 0).0,
                false => perhaps(None),
            })
            .count_perhaps("compulsory", |of| Some(of.counts()?.compulsory))
            .count("blocks", false, |of| of.found.blocks())
    }

    /// Ratios, and what misses are made of.
    fn ratios(self, windowed: bool) -> Self {
        let mut columns = self
            .per_query("reads_per_query", true, |counts| counts.records.reads, NONE)
            .per_query("accesses_per_query", false, |counts| counts.accesses, NONE)
            .per_query("fetches_per_query", true, |counts| counts.fetches, FETCHES);
        if windowed {
            columns = columns.in_table().headed("±");
        }
        columns
            .ratio("fetches_per_query_doubt", false, |of| of.half_width(of.found.fetches_per_query().doubt))
            .ratio("degrees_of_freedom", false, |of| of.found.fetches_per_query().spread.freedom)
            .ratio("fetches_per_block", true, |of| of.found.fetches_per_block().value)
            .ratio("fetches_per_block_error", false, |of| of.half_width(of.found.fetches_per_block().half_width()))
            .ratio("bytes_per_query", false, |of| of.found.bytes_per_query(BYTES(of)).value)
            .ratio("bytes_per_query_error", false, |of| of.half_width(of.found.bytes_per_query(BYTES(of)).half_width()))
            .number("capacity", false, |of| perhaps(of.counts().and_then(CacheCounts::capacity)))
            .number("conflict", false, |of| {
                of.counts().and_then(CacheCounts::conflict).map_or(perhaps(None), Value::Signed)
            })
            .number("page_switches", false, |of| of.found.page_switches())
            .ratio("page_switches_per_fetch", false, |of| of.found.page_switches_per_fetch())
    }

    /// Capacity and conflict miss by miss, if somebody asked.
    fn dinero(self, results: &[CacheResult]) -> Self {
        let asked = |of: &CacheResult| of.counts().is_some_and(|counts| counts.more.missed_by_both.is_some());
        if !results.iter().any(asked) {
            return self;
        }
        let perhaps = |of: &CacheResult, number: fn(&CacheCounts) -> Option<u64>| perhaps(of.counts().and_then(number));
        self.number("capacity_dinero", true, move |of| perhaps(of, CacheCounts::capacity_by_miss)).number(
            "conflict_dinero",
            true,
            move |of| perhaps(of, CacheCounts::conflict_by_miss),
        )
    }

    /// Rows of DRAM, if somebody asked.
    fn dram(self, results: &[CacheResult]) -> Self {
        let of_rows = |of: &CacheResult| of.counts().and_then(|counts| counts.more.dram);
        if !results.iter().any(|of| of_rows(of).is_some()) {
            return self;
        }
        self.number("row_hits", true, move |of| perhaps(of_rows(of).map(|rows| rows.hits)))
            .number("row_conflicts", true, move |of| perhaps(of_rows(of).map(|rows| rows.conflicts)))
            .number("activates", true, move |of| perhaps(of_rows(of).map(|rows| rows.activates)))
            .ratio("activates_per_fetch", true, |of| {
                of.counts().and_then(CacheCounts::activates_per_fetch).unwrap_or(f64::NAN)
            })
    }

    /// The longest chain of misses of a search, if somebody asked.
    fn miss_chains(self, results: &[CacheResult]) -> Self {
        let of_chains = |of: &CacheResult| of.counts().and_then(|counts| counts.more.miss_chains.clone());
        if !results.iter().any(|of| of_chains(of).is_some()) {
            return self;
        }
        self.ratio("miss_chain", true, move |of| of_chains(of).map_or(f64::NAN, |chains| chains.mean())).number(
            "miss_chain_max",
            true,
            move |of| perhaps(of_chains(of).and_then(|it| it.max()).map(u64::from)),
        )
    }

    /// What was prefetched, if somebody asked.
    fn prefetch(self, results: &[CacheResult]) -> Self {
        let of_prefetch = |of: &CacheResult| of.counts().and_then(|counts| counts.more.prefetch);
        if !results.iter().any(|of| of_prefetch(of).is_some()) {
            return self;
        }
        let count = move |of: &CacheResult, count: fn(PrefetchCounts) -> u64| perhaps(of_prefetch(of).map(count));
        let ratio = move |of: &CacheResult, ratio: fn(&PrefetchCounts) -> f64| {
            of_prefetch(of).map_or(f64::NAN, |it| ratio(&it))
        };
        self.text("prefetch", false, move |of| of_prefetch(of).map_or(String::new(), |it| it.prefetcher.to_string()))
            .number("fetches_unprefetched", false, move |of| count(of, |it| it.fetches_without))
            .number("prefetched", true, move |of| count(of, |it| it.prefetched))
            .number("prefetch_used", false, move |of| count(of, |it| it.used))
            .ratio("prefetch_accuracy", true, move |of| ratio(of, PrefetchCounts::accuracy))
            .ratio("prefetch_coverage", true, move |of| ratio(of, PrefetchCounts::coverage))
            .ratio("prefetch_traffic", true, move |of| ratio(of, PrefetchCounts::traffic))
    }

    /// Private caches and what they share, if there are several.
    fn private(self, results: &[CacheResult]) -> Self {
        let private = |of: &CacheResult| of.counts().and_then(|counts| counts.more.private.as_deref().cloned());
        if !results.iter().any(|of| private(of).is_some()) {
            return self;
        }
        let ratio =
            move |of: &CacheResult, ratio: fn(&PrivateCounts) -> f64| private(of).map_or(f64::NAN, |it| ratio(&it));
        let columns = self
            .number("private", true, move |of| perhaps(private(of).map(|it| it.elements)))
            .number("lines_shared", true, move |of| perhaps(private(of).map(|it| it.lines_shared)))
            .ratio("access_imbalance", true, move |of| ratio(of, PrivateCounts::access_imbalance))
            .ratio("fetch_imbalance", true, move |of| ratio(of, PrivateCounts::fetch_imbalance));
        let shared = move |of: &CacheResult| private(of).and_then(|it| it.shared);
        if !results.iter().any(|of| shared(of).is_some()) {
            return columns;
        }
        columns
            .text("shared_cache", false, move |of| shared(of).map_or(String::new(), |it| it.config.to_string()))
            .number("shared_fetches", true, move |of| perhaps(shared(of).map(|it| it.fetches)))
            .number("shared_bytes_fetched", false, move |of| perhaps(shared(of).map(|it| it.bytes_fetched)))
            .ratio("shared_fetches_per_query", true, move |of| match (shared(of), of.counts()) {
                (Some(shared), Some(counts)) => shared.fetches as f64 / counts.queries as f64,
                _ => f64::NAN,
            })
    }

    /// Distinct lines of searches and of batches.
    fn working_sets(mut self) -> Self {
        let of_searches: SetsOf = |sets| &sets.per_search;
        let of_batches: SetsOf = |sets| &sets.per_batch;
        for (name, of) in [("search", of_searches), ("batch", of_batches)] {
            let percentile = |percent| move |result: &CacheResult| result.sets(of)?.percentile(percent).map(u64::from);
            let mean = move |result: &CacheResult| match name {
                "search" => result.found.lines_per_search(),
                _ => result.sets(of).map_or(f64::NAN, Distribution::mean),
            };
            self = self
                .count_perhaps(&format!("{name}es"), move |result| Some(result.sets(of)?.number()))
                .ratio(&format!("lines_per_{name}_mean"), false, mean)
                .count_perhaps(&format!("lines_per_{name}_p50"), percentile(50))
                .count_perhaps(&format!("lines_per_{name}_p90"), percentile(90))
                .count_perhaps(&format!("lines_per_{name}_max"), move |result| result.sets(of)?.max().map(u64::from));
        }
        self.count_perhaps("batch_floor", move |of| Some(of.sets(of_batches)?.sum()))
    }

    /// Traffic of queries and results, and what all costs together.
    fn other_traffic(self) -> Self {
        // What was spilled of a sample is not what would be of all.
        self.count_perhaps("query_bytes", |of| of.counts().map(|_| of.query_bytes))
            .number("result_bytes", false, |of| perhaps(of.result_bytes))
            .number("total_bytes", false, |of| perhaps(of.total_bytes()))
            .count("order_bytes_on_chip", false, |of| of.order_bytes)
    }

    /// How much was measured.
    fn windows(self, windowed: bool) -> Self {
        self.count("windows", windowed, |of| of.found.windows().map_or(0, |windows| windows.windows.len() as u64))
            .count("windows_inexact", windowed, |of| of.found.windows().map_or(0, |windows| windows.windows_inexact()))
            .count("queries_measured", false, |of| of.found.queries_measured())
            .count("queries_simulated", windowed, |of| of.found.queries_simulated())
            .ratio("sample_share", false, |of| match of.found.windows() {
                Some(windows) => windows.share.unwrap_or(f64::NAN),
                None if of.sample.is_empty() => 1.0,
                None => f64::NAN,
            })
    }

    /// Fetches of each region of any trace.
    fn fetches_of_regions(mut self, results: &[CacheResult]) -> Self {
        let regions = results.iter().flat_map(|of| of.regions.iter().map(|name| column_name(name)));
        for region in regions.collect::<BTreeSet<String>>() {
            let names = [format!("fetches_{region}"), format!("fetches_{region}_error")];
            // A region called `per_query` would be another column.
            if self.has_any(&names) {
                continue;
            }
            let total = move |of: &CacheResult| {
                let sum = of.of_regions(&region);
                of.found.total(|counts| sum(&counts.region_fetches), |window| sum(&window.unknown))
            };
            let again = total.clone();
            self = self
                .number(&names[0], false, move |of| total(of).0)
                .ratio(&names[1], false, move |of| of.half_width(again(of).1));
        }
        self
    }
}
