//! What came of one cache and one trace.

use super::found::Found;
use pm_caches::{CacheConfig, CacheCounts, Distribution, WorkingSets};
use std::rc::Rc;

/// What came of one cache and one trace.
pub(super) struct CacheResult {
    /// The name of the trace's file, as it was typed.
    pub(super) trace: Rc<str>,
    /// The photon map, if it is a trace of one.
    pub(super) map: Rc<str>,
    /// The order of the queries.
    pub(super) order: String,
    /// Which part of the stream the trace is of, in words; empty if it is of all.
    pub(super) sample: String,
    /// Searches in flight at a time.
    pub(super) lanes: u16,
    /// What was found of the cache.
    pub(super) found: Found,
    /// The commands that the trace came by.
    pub(super) history: Rc<str>,
    /// Names of the regions of the trace.
    pub(super) regions: Rc<Vec<String>>,
    /// Bytes of queries spilled to memory and read back by the stages before.
    pub(super) query_bytes: u64,
    /// Bytes on chip that the stages before needed to order the queries.
    pub(super) order_bytes: u64,
    /// Bytes read and written for results, if they were counted.
    pub(super) result_bytes: Option<u64>,
}

impl CacheResult {
    /// The exact counts, if there are such of the whole trace.
    pub(super) fn counts(&self) -> Option<&CacheCounts> {
        match &self.found {
            Found::Exact(counts) => Some(counts),
            Found::Windows(_) => None,
        }
    }

    /// Map, queries and results together.
    pub(super) fn total_bytes(&self) -> Option<u64> {
        Some(self.counts()?.traffic_bytes().saturating_add(self.query_bytes).saturating_add(self.result_bytes?))
    }

    /// Adds up numbers of the regions whose name in a column is this.
    pub(super) fn of_regions(&self, name: &str) -> impl Fn(&[u64]) -> u64 + use<> {
        let named: Vec<bool> = self.regions.iter().map(|region| column_name(region) == name).collect();
        move |numbers| named.iter().zip(numbers).map(|(named, number)| u64::from(*named) * number).sum()
    }

    /// How the working sets of its searches, or of its batches, are distributed.
    pub(super) fn sets(&self, of: SetsOf) -> Option<&Distribution> {
        self.counts()?.more.working_sets.as_deref().map(of)
    }

    /// The cache.
    pub(super) fn config(&self) -> &CacheConfig {
        self.found.config()
    }

    /// Half the width of an interval; of a whole stream there is nothing to estimate, and a sample that is not one of
    /// windows does not tell.
    pub(super) fn half_width(&self, estimated: f64) -> f64 {
        match &self.found {
            Found::Windows(_) => estimated,
            Found::Exact(_) if self.sample.is_empty() => 0.0,
            Found::Exact(_) => f64::NAN,
        }
    }
}

/// The working sets of searches, or those of batches.
pub(super) type SetsOf = fn(&WorkingSets) -> &Distribution;

/// A region's name as part of a column's: `split planes` is `split_planes`.
pub(super) fn column_name(region: &str) -> String {
    region.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect()
}
