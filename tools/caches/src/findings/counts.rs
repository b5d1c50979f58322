//! What a simulation found out, for one cache.

use std::rc::Rc;

use super::{Distribution, RecordCounts, WorkingSets};
use crate::{CacheConfig, DramCounts, PrefetchCounts, PrivateCounts};

/// One cache and what the trace cost with it: exact counts as fields, ratios as methods.
///
/// Counts leave warm-up out. A ratio to nothing (per query without queries) is not a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CacheCounts {
    /// The cache, as it was simulated.
    pub config: CacheConfig,
    /// Queries answered: the sum of the searches' destinations.
    pub queries: u64,
    /// Searches made; one search can answer several queries.
    pub searches: u64,
    /// Record accesses over all regions, and their bytes.
    pub records: RecordCounts,
    /// Line accesses: the pieces of records, cut where lines end.
    pub accesses: u64,
    /// Lines fetched from memory. Without a cache: records read, each fetched by itself.
    pub fetches: u64,
    /// Bytes fetched from memory: whole lines; without a cache, the bytes of the records read.
    pub bytes_fetched: u64,
    /// Bytes written back to memory: whole lines; without a cache, the bytes of the records written.
    pub bytes_written_back: u64,
    /// Distinct lines, first touched by a counted access: what a cache of any size must fetch.
    pub compulsory: u64,
    /// Blocks of memory: bytes of all regions over bytes of a line, rounded up.
    pub blocks: u64,
    /// Fetches for accesses to each region, in the trace's order of regions; they add up to `fetches`.
    pub region_fetches: Vec<u64>,
    /// What was to be found out besides.
    pub more: AskedCounts,
}

/// Counts of a cache that have to be asked for by [`Measures`](crate::Measures); `None` if they were not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AskedCounts {
    /// Lines that a fully associative LRU cache of the same size and line fetches. `None` where there is no cache, too.
    pub full_lru_fetches: Option<u64>,
    /// How often the DRAM page changed from one fetch to the next.
    pub page_switches: Option<u64>,
    /// Rows of DRAM that fetches found open, or had to open.
    pub dram: Option<DramCounts>,
    /// Misses, compulsory ones included, that the fully associative LRU cache of the same size and line has too.
    pub missed_by_both: Option<u64>,
    /// Searches by the longest chain of each: of misses each of which waits for the one before.
    pub miss_chains: Option<Distribution>,
    /// Where the cache is one of several private ones, what they have in common.
    pub private: Option<Box<PrivateCounts>>,
    /// With a prefetcher, what it was good for.
    pub prefetch: Option<PrefetchCounts>,
    /// Distinct lines of searches and batches; the same for all caches of a line size.
    pub working_sets: Option<Rc<WorkingSets>>,
}

impl CacheCounts {
    /// Bytes the trace reads and writes, records as they are: the traffic without any cache.
    #[must_use]
    pub fn raw_bytes(&self) -> u64 {
        self.records.bytes_read + self.records.bytes_written
    }

    /// Bytes to and from memory: fetched and written back.
    #[must_use]
    pub fn traffic_bytes(&self) -> u64 {
        self.bytes_fetched + self.bytes_written_back
    }

    /// How many times each block is fetched on average, the unit of Steinhurst, Coombe and Lastra, *Reordering for Cache
    /// Conscious Photon Mapping*, GI 2005: fetches / blocks.
    #[must_use]
    pub fn fetches_per_block(&self) -> f64 {
        ratio(self.fetches, self.blocks)
    }

    /// Records read (read-modify-writes not among them) for each query.
    #[must_use]
    pub fn reads_per_query(&self) -> f64 {
        ratio(self.records.reads, self.queries)
    }

    /// Lines fetched for each query.
    #[must_use]
    pub fn fetches_per_query(&self) -> f64 {
        ratio(self.fetches, self.queries)
    }

    /// Bytes to and from memory for each query.
    #[must_use]
    pub fn bytes_per_query(&self) -> f64 {
        ratio(self.traffic_bytes(), self.queries)
    }

    /// Capacity misses (Hill and Smith, *Evaluating associativity in CPU caches*, IEEE TC 38, 1989): what a fully
    /// associative LRU cache of the same size fetches beyond the compulsory.
    #[must_use]
    pub fn capacity(&self) -> Option<u64> {
        Some(self.more.full_lru_fetches?.saturating_sub(self.compulsory))
    }

    /// Conflict misses: what the cache fetches beyond a fully associative LRU cache of the same size. Below zero where
    /// sets or another policy do better than that.
    #[must_use]
    pub fn conflict(&self) -> Option<i64> {
        Some(self.fetches as i64 - self.more.full_lru_fetches? as i64)
    }

    /// Capacity misses as Dinero IV counts them (`-ccc`), miss by miss: lines touched before that the fully associative LRU
    /// cache of the same size misses too.
    #[must_use]
    pub fn capacity_by_miss(&self) -> Option<u64> {
        Some(self.more.missed_by_both?.saturating_sub(self.compulsory))
    }

    /// Conflict misses as Dinero IV counts them: those that the fully associative LRU cache of the same size does not have.
    /// Never below zero; what that cache misses and this one does not is not set off against them.
    #[must_use]
    pub fn conflict_by_miss(&self) -> Option<u64> {
        Some(self.fetches.saturating_sub(self.more.missed_by_both?))
    }

    /// Rows of DRAM activated for each fetch.
    #[must_use]
    pub fn activates_per_fetch(&self) -> Option<f64> {
        Some(ratio(self.more.dram?.activates, self.fetches))
    }

    /// Changes of the DRAM page for each fetch.
    #[must_use]
    pub fn page_switches_per_fetch(&self) -> Option<f64> {
        Some(ratio(self.more.page_switches?, self.fetches))
    }

    /// Fetches for each line access.
    #[must_use]
    pub fn miss_rate(&self) -> f64 {
        ratio(self.fetches, self.accesses)
    }
}

/// `a / b`; 0 / 0 is not a number.
fn ratio(a: u64, b: u64) -> f64 {
    a as f64 / b as f64
}
