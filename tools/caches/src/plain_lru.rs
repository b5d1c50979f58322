//! LRU caches as lists of lines, and traces in batches: what tests of several modules are held against.

use std::collections::{BTreeMap, BTreeSet};

use pm_formats::trace::{Access, AccessKind, Region, TraceSink};

use crate::trial::Event;
use crate::{CacheConfig, CacheCounts, Findings, Measures, Simulation, Ways};

/// The batch of the i-th block: some stay, some change, some come back.
pub(crate) fn batch(block: u64) -> u64 {
    block * block / 3 % 3
}

pub(crate) fn replay_in_batches(events: &[Event], sink: &mut impl TraceSink) {
    let mut blocks = 0;
    sink.block(batch(0), false);
    for event in events {
        match event {
            Event::Block { warm_up } => {
                blocks += 1;
                sink.block(batch(blocks), *warm_up);
            }
            Event::Search(destinations) => sink.search(destinations),
            Event::Access(access) => sink.access(*access),
        }
    }
}

pub(crate) fn findings(
    regions: &[Region],
    configs: &[CacheConfig],
    measures: &Measures,
    events: &[Event],
    chunk: usize,
) -> Findings {
    let mut simulation = Simulation::in_chunks(regions, configs, measures, chunk).unwrap();
    replay_in_batches(events, &mut simulation);
    simulation.findings()
}

/// The lines that an access touches.
pub(crate) fn lines(regions: &[Region], access: Access, line: u64) -> std::ops::RangeInclusive<u64> {
    let first = regions[access.region as usize].base + access.offset;
    first / line..=(first + u64::from(access.len.max(1)) - 1) / line
}

/// Sets of lists, most recent first: region, line, whether counted and index of the event, of each fetch in order.
pub(crate) fn naive_fetches(regions: &[Region], config: CacheConfig, events: &[Event]) -> Vec<(u16, u64, bool, usize)> {
    let sets = match config.ways() {
        Ways::Full => 1,
        Ways::N(ways) => config.lines() / u64::from(ways.get()),
    };
    let mut lists = vec![Vec::new(); sets as usize];
    let (mut counted, mut fetches) = (true, vec![]);
    for (i, event) in events.iter().enumerate() {
        match event {
            Event::Block { warm_up } => counted = !warm_up,
            Event::Search(_) => {}
            Event::Access(access) => {
                for line in lines(regions, *access, config.line_bytes().into()) {
                    let list = &mut lists[(line % sets) as usize];
                    match list.iter().position(|&known| known == line) {
                        Some(at) => drop(list.remove(at)),
                        None => fetches.push((access.region, line, counted, i)),
                    }
                    list.insert(0, line);
                    list.truncate((config.lines() / sets) as usize);
                }
            }
        }
    }
    fetches
}

/// The oracle: a cache as a list of lines, most recent first, in the plainest way there is.
pub(crate) fn oracle(regions: &[Region], config: CacheConfig, events: &[Event]) -> CacheCounts {
    let line_bytes = u64::from(config.line_bytes());
    let sets = match config.ways() {
        Ways::Full => 1,
        Ways::N(ways) => config.lines() / u64::from(ways.get()),
    };
    let mut lists: BTreeMap<u64, Vec<(u64, bool)>> = BTreeMap::new();
    let mut touched = BTreeSet::new();
    let mut row = CacheCounts {
        config,
        queries: 0,
        searches: 0,
        records: Default::default(),
        accesses: 0,
        fetches: 0,
        bytes_fetched: 0,
        bytes_written_back: 0,
        compulsory: 0,
        blocks: regions.iter().map(|r| r.size).sum::<u64>().div_ceil(line_bytes),
        region_fetches: vec![0; regions.len()],
        more: Default::default(),
    };
    let (mut counted, mut write_backs) = (true, 0);
    for event in events {
        let access = match event {
            Event::Block { warm_up } => {
                counted = !warm_up;
                continue;
            }
            Event::Search(destinations) => {
                row.searches += u64::from(counted);
                row.queries += destinations.len() as u64 * u64::from(counted);
                continue;
            }
            Event::Access(access) => access,
        };
        let (reads, writes) = (access.kind != AccessKind::Write, access.kind != AccessKind::Read);
        if counted {
            let counts = &mut row.records;
            match access.kind {
                AccessKind::Read => counts.reads += 1,
                AccessKind::Write => counts.writes += 1,
                AccessKind::ReadModifyWrite => counts.read_modify_writes += 1,
            }
            counts.bytes_read += u64::from(access.len) * u64::from(reads);
            counts.bytes_written += u64::from(access.len) * u64::from(writes);
        }
        let first_byte = regions[access.region as usize].base + access.offset;
        let last_byte = first_byte + u64::from(access.len.max(1)) - 1;
        for line in first_byte / line_bytes..=last_byte / line_bytes {
            row.accesses += u64::from(counted);
            row.compulsory += u64::from(touched.insert(line) && counted);
            let list = lists.entry(line % sets).or_default();
            let dirty = match list.iter().position(|&(l, _)| l == line) {
                Some(at) => list.remove(at).1,
                None => {
                    row.region_fetches[access.region as usize] += u64::from(counted);
                    false
                }
            };
            list.insert(0, (line, dirty || (writes && counted)));
            if list.len() as u64 > config.lines() / sets {
                write_backs += u64::from(list.pop().unwrap().1);
            }
        }
    }
    write_backs += lists.values().flatten().filter(|(_, dirty)| *dirty).count() as u64;
    row.fetches = row.region_fetches.iter().sum();
    row.bytes_fetched = row.fetches * line_bytes;
    row.bytes_written_back = write_backs * line_bytes;
    row
}
