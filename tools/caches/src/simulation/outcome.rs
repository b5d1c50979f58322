//! What a simulation found, once the trace is over.

use std::{collections::BTreeMap, rc::Rc};

use super::Simulation;
use crate::findings::ResultTraffic;
use crate::lines::PAGE_SHIFT;
use crate::misses::Chains;
use crate::models::LineCounts;
use crate::{AskedCounts, CacheConfig, CacheCounts, Findings, RecordCounts, TraceCounts};

impl Simulation {
    /// Ends the simulation: all that it found.
    ///
    /// # Panics
    ///
    /// As an access may: see [`Simulation`].
    #[must_use]
    pub fn findings(mut self) -> Findings {
        self.flush();
        assert!(self.fault.is_none(), "nobody asked whether all went well");
        let mut records = RecordCounts::default();
        self.record_counts.iter().for_each(|counts| records.add(counts));
        let mut caches = vec![None; self.configs.len()];
        let (mut curves, mut sampled) = (BTreeMap::new(), BTreeMap::new());
        for group in std::mem::take(&mut self.groups) {
            let line_bytes = group.space.line_bytes();
            let (queries, accesses, blocks) = (self.queries, group.accesses, self.blocks(line_bytes.into()));
            let trace = TraceCounts { line_bytes, queries, records, accesses, blocks };
            curves.extend(group.curve.map(|curve| (line_bytes, curve.finish(trace))));
            sampled.extend(group.shards.map(|shards| (line_bytes, shards.finish(trace))));
            let sets = group.working_sets.map(|sets| Rc::new(sets.finish()));
            let twins = group.twins;
            for running in group.models {
                let lines = running.model.finish();
                for cache in running.caches {
                    let config = self.configs[cache.config];
                    let mut counts = self.counts(config, &trace, &lines[cache.counts], &cache.spared);
                    let pages = if config.keeps_lines() { &cache.pages } else { &self.record_pages };
                    counts.more.page_switches = pages.as_ref().map(|pages| pages.switches);
                    let banks = if config.keeps_lines() { &cache.banks } else { &self.record_banks };
                    counts.more.dram = banks.as_ref().map(|banks| banks.counts);
                    counts.more.miss_chains = cache.chains.map(Chains::finish);
                    let twins = twins.as_ref().filter(|_| config.keeps_lines());
                    counts.more.missed_by_both = twins.map(|of| of.both(cache.config).unwrap_or(counts.fetches));
                    counts.more.working_sets = sets.clone();
                    caches[cache.config] = Some(counts);
                }
            }
        }
        let lines = &self.measures.curves;
        Findings {
            caches: self.without_twins(caches.into_iter().flatten().collect()),
            curves: lines.iter().filter_map(|line| curves.get(line).cloned()).collect(),
            sampled: lines.iter().filter_map(|line| sampled.get(line).cloned()).collect(),
            result_bytes: self.results.map(ResultTraffic::finish),
        }
    }

    /// The counts of the caches asked for, each with the fetches of its twin.
    fn without_twins(&self, mut caches: Vec<CacheCounts>) -> Vec<CacheCounts> {
        let twins = caches.split_off(self.asked);
        if self.measures.split || self.measures.miss_by_miss {
            let mut twins = twins.into_iter();
            for counts in caches.iter_mut().filter(|counts| counts.config.keeps_lines()) {
                let twin = if counts.config.full_lru_twin().is_some() { twins.next() } else { None };
                counts.more.full_lru_fetches = Some(twin.map_or(counts.fetches, |twin| twin.fetches));
            }
        }
        caches
    }

    /// Bytes of all regions over bytes of a line, rounded up.
    fn blocks(&self, line: u64) -> u64 {
        if let Some(places) = self.places.get(&PAGE_SHIFT) {
            return ((places.pages().len() as u64) << PAGE_SHIFT).div_ceil(line);
        }
        // 2^16 sizes may add up to more than 64 bits; their lines were checked to be few.
        let bytes: u128 = self.regions.iter().map(|r| u128::from(r.size)).sum();
        bytes.div_ceil(line.into()) as u64
    }

    fn counts(&self, config: CacheConfig, trace: &TraceCounts, lines: &LineCounts, spared: &[u64]) -> CacheCounts {
        let line = u64::from(config.line_bytes());
        let (cached, records) = (config.keeps_lines(), trace.records);
        let region_fetches: Vec<u64> = if cached {
            lines.fetches.iter().zip(spared).map(|(fetches, spared)| fetches - spared).collect()
        } else {
            self.record_counts.iter().map(|counts| counts.reads + counts.read_modify_writes).collect()
        };
        let fetches = region_fetches.iter().sum();
        let lines_fetched: u64 = lines.fetches.iter().sum();
        CacheCounts {
            config,
            queries: self.queries,
            searches: self.searches,
            records,
            accesses: trace.accesses,
            fetches,
            bytes_fetched: if cached { lines_fetched * line } else { records.bytes_read },
            bytes_written_back: if cached { lines.write_backs * line } else { records.bytes_written },
            compulsory: lines.compulsory,
            blocks: trace.blocks,
            region_fetches,
            more: AskedCounts::default(),
        }
    }
}
