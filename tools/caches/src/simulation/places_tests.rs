//! Traces of all addresses: do those count that nobody could lay out?

use pm_formats::trace::{Access, Region, TraceSink, lay_out};

use super::Simulation;
use crate::trial::{Draw, pages, replay, wild_events};
use crate::{CacheConfig, Findings, Measures, SimulationError, SpanRule, Ways, policies};

fn findings(measures: &Measures, caches: &[CacheConfig], addresses: impl Iterator<Item = u64>) -> Findings {
    let mut simulation = Simulation::measuring(&[Region::addresses("x")], caches, measures).unwrap();
    addresses.for_each(|offset| simulation.access(Access::read(0, offset, 1)));
    simulation.check().unwrap();
    simulation.findings()
}

fn configs(texts: &[&str]) -> Vec<CacheConfig> {
    texts.iter().map(|text| CacheConfig::parse(text, &policies()).unwrap()).collect()
}

#[test]
fn pages_far_apart_are_no_more_blocks_than_those_touched() {
    // Every third page; more runs of pages than an access can name regions.
    for number in [65_537_u64, 100_000] {
        let found = findings(
            &Measures::default(),
            &configs(&["128K,full,128,lru", "128K,8,128,lru"]),
            (0..number).map(|i| (3 * i) << 12),
        );
        for counts in found.caches {
            assert_eq!((counts.fetches, counts.compulsory, counts.blocks), (number, number, 32 * number));
            assert!((counts.fetches_per_block() - 0.031_25).abs() < 1e-12);
        }
    }
}

#[test]
fn identifiers_may_be_any_numbers() {
    let hashed = |i: u64| (i << 40, i.wrapping_mul(0x9e37_79b9_7f4a_7c15), u64::MAX - i);
    for pick in [|of: (u64, u64, u64)| of.0, |of: (u64, u64, u64)| of.1, |of: (u64, u64, u64)| of.2] {
        // Each twice, first to last: a cache for all of them hits the second time, half of one never.
        let addresses = (0..2).flat_map(|_| 0..65_537_u64).map(|i| pick(hashed(i % (1 << 23))) & !127);
        let distinct = addresses.clone().collect::<std::collections::BTreeSet<u64>>().len() as u64;
        let caches = configs(&["8G,full,128,lru", "8G,full,128,fifo", "8G,full,128,min", "8G,4,2G,lru", "none"]);
        let found = findings(&Measures::default(), &caches, addresses);
        assert!(found.caches[..3].iter().all(|counts| counts.fetches == distinct));
        assert!(found.caches.iter().all(|counts| counts.accesses == 2 * 65_537));
    }
}

#[test]
fn curves_are_those_of_caches_one_by_one() {
    let mut draw = Draw::new(41);
    for case in 0..200 {
        let events = wild_events(&mut draw);
        let lines = [16_u32, 128, 8192];
        // A sample of all lines is the curve itself.
        let measures = Measures { curves: lines.into(), sampled: Some(1.0), exact_too: true, ..Measures::default() };
        let sizes = [1_u64, 2, 7, 40, 1000];
        let caches: Vec<CacheConfig> = lines
            .iter()
            .flat_map(|&line| sizes.map(|size| CacheConfig::lru(size * u64::from(line), Ways::Full, line).unwrap()))
            .collect();
        let chunk = draw.pick(&[1, 30, 2048]);
        let mut simulation = Simulation::in_chunks(&[Region::addresses("x")], &caches, &measures, chunk).unwrap();
        replay(&events, &mut simulation);
        let found = simulation.findings();
        for counts in &found.caches {
            let at = lines.iter().position(|&line| line == counts.config.line_bytes()).unwrap();
            let size = counts.config.lines();
            assert_eq!(found.curves[at].fetches(size), counts.fetches, "case {case}: {}", counts.config);
            assert_eq!(
                found.curves[at].write_backs(size) * u64::from(counts.config.line_bytes()),
                counts.bytes_written_back
            );
            assert_eq!(
                found.sampled[at].fetches(size.max(100)).map(|e| e.fetches as u64),
                Some(found.curves[at].fetches(size.max(100)))
            );
            assert_eq!(counts.blocks, (pages(&events) * 4096).div_ceil(counts.config.line_bytes().into()));
        }
    }
}

#[test]
fn sampled_lines_do_not_depend_on_who_comes_first() {
    let measures = Measures { curves: vec![64], sampled: Some(0.3), ..Measures::default() };
    let curve = |addresses: &mut dyn Iterator<Item = u64>| findings(&measures, &[], addresses).sampled.remove(0);
    let there = |i: u64| i.wrapping_mul(0x1234_5678_9abc_def1);
    // Only first touches: as many lines are sampled whatever their order.
    let (up, down) = (curve(&mut (0..5000).map(there)), curve(&mut (0..5000).rev().map(there)));
    assert_eq!(up.fetches(1000).map(|e| e.fetches), down.fetches(1000).map(|e| e.fetches));
}

#[test]
fn a_record_that_goes_on_in_the_page_behind_is_one() {
    for (span, fetches) in [(SpanRule::Both, 4), (SpanRule::First, 1)] {
        let measures = Measures { span, ..Measures::default() };
        let caches = configs(&["1K,full,64,lru"]);
        let mut simulation = Simulation::measuring(&[Region::addresses("x")], &caches, &measures).unwrap();
        // The page behind is known already, and has not the place behind.
        simulation.block(0, true);
        simulation.access(Access::read(0, 8192, 1));
        simulation.access(Access::read(0, 1 << 50, 1));
        simulation.block(0, false);
        simulation.access(Access::read(0, 8192 - 70, 200));
        let counts = simulation.finish().remove(0);
        assert_eq!((counts.records.reads, counts.records.bytes_read, counts.fetches), (1, 200, fetches));
        assert_eq!(counts.blocks, 3 * 64);
    }
}

#[test]
fn all_addresses_stand_alone() {
    let regions = lay_out([("a".to_owned(), 100, 4, pm_formats::trace::Coding::Records)]);
    let both = [&regions[..], &[Region::addresses("x")]].concat();
    assert_eq!(Simulation::new(&both, &[]).err(), Some(SimulationError::AddressesAndRegions));
}

#[test]
#[should_panic(expected = "outside of its region")]
fn an_access_beyond_the_last_address_is_none() {
    let mut simulation = Simulation::new(&[Region::addresses("x")], &[]).unwrap();
    simulation.access(Access::read(0, u64::MAX, 2));
    let _ = simulation.finish();
}
