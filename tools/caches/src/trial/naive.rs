//! Does every policy count what its definition does?

use std::collections::{BTreeMap, BTreeSet};

use pm_registry::Registry;

use super::caches::{of_caches, random_cache};
use super::definition::{FullSet, HeldLine, LineAccess, line_accesses, set_of};
use super::{Draw, random_events, random_regions, replay, simulate};
use crate::simulation::Moved;
use crate::{CacheConfig, CacheCounts, Measures, Policy, Simulation, SimulationError, Ways};

/// What a cache costs: fetches by region, compulsory fetches, write-backs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Cost {
    pub(crate) fetches: Vec<u64>,
    compulsory: u64,
    write_backs: u64,
}

impl Cost {
    pub(crate) fn of(counts: &CacheCounts) -> Self {
        let write_backs = counts.bytes_written_back / u64::from(counts.config.line_bytes());
        Self { fetches: counts.region_fetches.clone(), compulsory: counts.compulsory, write_backs }
    }

    /// All fetches.
    pub(super) fn total(&self) -> u64 {
        self.fetches.iter().sum()
    }
}

/// A cache by its policy's definition: what it costs, and each line fetched or, before it, written back in order, those of the
/// warm-up too. Of a line written back no region is told.
pub(super) fn naive(config: CacheConfig, regions: usize, accesses: &[LineAccess]) -> (Cost, Vec<Moved>) {
    let sets = config.sets();
    let ways = config.lines() / sets;
    let policy = config.policy();
    let mut definition = policy.entry().definition(sets, ways, policy.seed());
    let mut cache: BTreeMap<u64, Vec<HeldLine>> = BTreeMap::new();
    let mut touched = BTreeSet::new();
    let mut cost = Cost { fetches: vec![0; regions], ..Cost::default() };
    let mut moves = vec![];
    // The line at hand, if it passes the cache by, and whether it is dirty.
    let mut passing: Option<(u64, bool)> = None;
    for (now, &LineAccess { line, writes, counted, region }) in accesses.iter().enumerate() {
        let set = set_of(line, sets, config.index());
        let held = cache.entry(set).or_default();
        let first = touched.insert(line);
        if let Some((at_hand, dirty)) = &mut passing {
            if *at_hand == line {
                *dirty |= writes && counted;
                continue;
            }
            cost.write_backs += u64::from(*dirty);
            passing = None;
        }
        let way = if let Some(way) = held.iter().position(|held| held.line == line) {
            held[way].uses.push(now);
            way
        } else {
            let fetch = Moved { region: region as u16, line, written: false };
            cost.fetches[region] += u64::from(counted);
            cost.compulsory += u64::from(counted && first);
            let new = HeldLine { line, dirty: false, uses: vec![now] };
            if (held.len() as u64) < ways {
                held.push(new);
                moves.push(fetch);
                held.len() - 1
            } else if let Some(victim) = definition.victim(&FullSet { set, held, accesses, now }) {
                let before = &held[victim];
                if before.dirty {
                    cost.write_backs += 1;
                    moves.push(Moved { region: 0, line: before.line, written: true });
                }
                moves.push(fetch);
                held[victim] = new;
                victim
            } else {
                moves.push(fetch);
                passing = Some((line, writes && counted));
                continue;
            }
        };
        held[way].dirty |= writes && counted;
        definition.used(set, way);
    }
    let left = cache.values().flatten().filter(|held| held.dirty).count();
    cost.write_backs += left as u64 + u64::from(passing.is_some_and(|(_, dirty)| dirty));
    (cost, moves)
}

/// Fetches by region, compulsory fetches and write-backs of random caches on random traces are those of the policy's
/// definition, however many accesses are simulated at a time.
///
/// # Panics
/// If they are not.
pub fn counts_are_those_of_the_definition(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(11);
    let policies = of_caches(policies);
    for case in 0..2000 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let configs: Vec<CacheConfig> = policies.iter().map(|&policy| random_cache(&mut draw, policy)).collect();
        let chunk = draw.pick(&[1, 2, 5, 60, 2048]);
        for &config in &configs {
            // By itself, so that it sees repeats only if it asks for them.
            let counts = &simulate(&regions, &[config], &events, chunk)[0];
            let accesses = line_accesses(&regions, config.line_bytes(), &events);
            let (expected, _) = naive(config, regions.len(), &accesses);
            assert_eq!(
                Cost::of(counts),
                expected,
                "case {case}, {config}, chunk {chunk}: left: model, right: definition"
            );
            assert_eq!((counts.config, counts.fetches), (config, expected.total()));
        }
    }
}

/// The moves that are fetches.
pub(super) fn fetches(moves: Vec<Moved>) -> Vec<Moved> {
    moves.into_iter().filter(|moved| !moved.written).collect()
}

/// A model tells of each miss when it happens, in order, and of each dirty line that leaves if it can tell that.
///
/// # Panics
/// If it does not.
pub fn fetches_are_told_as_they_happen(policies: &Registry<dyn Policy>) {
    let mut draw = Draw::new(16);
    let (mut told, mut written_back) = (0, 0);
    for case in 0..400 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        for policy in of_caches(policies) {
            let config = random_cache(&mut draw, policy);
            // A second cache of the same lines: under LRU both are answered by one stack.
            let beside = CacheConfig::lru(8 * u64::from(config.line_bytes()), Ways::Full, config.line_bytes());
            let configs = [config, beside.expect("eight lines")];
            let chunk = draw.pick(&[1, 2, 5, 60, 2048]);
            let moves = |write_backs: bool| {
                let measures = Measures { write_backs, ..Measures::default() };
                let mut simulation = Simulation::in_chunks(&regions, &configs, &measures, chunk)?;
                simulation.keep_fetched();
                replay(&events, &mut simulation);
                let mut moves = vec![];
                simulation.take_fetched(&mut moves);
                Ok::<_, SimulationError>((moves, Cost::of(&simulation.finish()[0])))
            };
            let accesses = line_accesses(&regions, config.line_bytes(), &events);
            let (cost, expected) = naive(config, regions.len(), &accesses);
            let what = format!("case {case}, {config}, chunk {chunk}: left: model, right: definition");
            match moves(true) {
                Ok((mut moves, found)) => {
                    moves.iter_mut().filter(|moved| moved.written).for_each(|moved| moved.region = 0);
                    assert_eq!((&moves, found), (&expected, cost), "{what}");
                    written_back += moves.len() - fetches(moves).len();
                }
                Err(error) => assert_eq!(error, SimulationError::NoWriteBacks(config)),
            }
            let (fetched, _) = moves(false).expect("small regions");
            told += fetched.len();
            assert_eq!(fetched, fetches(expected), "{what}");
        }
    }
    assert!(told > 100_000 && written_back > 10_000, "{told} fetches, {written_back} lines written back are no test");
}
