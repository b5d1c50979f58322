//! Do the counts agree with what can be known otherwise?

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink, lay_out};

use super::Simulation;
use crate::plain_lru::oracle;
use crate::trial::{Draw, Event, random_events, random_regions, simulate};
use crate::{CacheConfig, Measures, Ways};

fn random_configs(draw: &mut Draw) -> Vec<CacheConfig> {
    (0..draw.below(8) + 1)
        .map(|_| {
            let line = draw.pick(&[4, 16, 128, 128, 8192]);
            let ways = draw.pick(&[0, 0, 1, 2, 3, 8]);
            let lines = match ways {
                0 => draw.pick(&[1, 2, 3, 7, 20, 64, 100_000]),
                _ => ways << draw.below(5),
            };
            let ways = std::num::NonZeroU32::new(ways as u32).map_or(Ways::Full, Ways::N);
            CacheConfig::lru(lines * u64::from(line), ways, line).unwrap()
        })
        .collect()
}

#[test]
fn every_count_is_that_of_a_plain_list() {
    let mut draw = Draw::new(1);
    for case in 0..3000 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let configs = random_configs(&mut draw);
        let chunk = draw.pick(&[1, 2, 5, 60, 4096]);
        let rows = simulate(&regions, &configs, &events, chunk);
        assert_eq!(rows.len(), configs.len());
        for (row, &config) in rows.iter().zip(&configs) {
            assert_eq!(*row, oracle(&regions, config, &events), "case {case}, {config}, chunk {chunk}");
            assert_eq!(row.region_fetches.iter().sum::<u64>(), row.fetches);
        }
    }
}

#[test]
fn a_trace_longer_than_many_chunks_agrees_too() {
    // Queues grow, are tidied and start over, which short traces never see.
    let mut draw = Draw::new(2);
    let regions = lay_out([("map".to_owned(), 64_000, 20, Coding::Records)]);
    let mut events = Vec::new();
    for search in 0..300 {
        let around = if search / 50 % 2 == 0 { draw.below(3000) } else { search * 4 };
        for _ in 0..300 {
            let record = (around + draw.below(100) * draw.below(3)).min(3199);
            let record = if draw.below(3) == 0 { record >> draw.below(12) } else { record };
            events.push(Event::Access(Access::read(0, record * 20, 20)));
        }
    }
    let configs: Vec<CacheConfig> =
        ["64,full,64,lru", "1K,full,64,lru", "8K,full,64,lru", "32K,full,64,lru", "4K,4,64,lru"]
            .iter()
            .map(|text| text.parse().unwrap())
            .collect();
    let rows = simulate(&regions, &configs, &events, 4096);
    for (row, &config) in rows.iter().zip(&configs) {
        assert_eq!(*row, oracle(&regions, config, &events), "{config}");
    }
}

#[test]
fn caches_do_not_disturb_one_another() {
    let mut draw = Draw::new(3);
    for _ in 0..200 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        let mut configs = random_configs(&mut draw);
        configs.push(CacheConfig::none(16).unwrap());
        configs.extend(random_configs(&mut draw));
        let together = simulate(&regions, &configs, &events, 4096);
        let alone = configs.iter().flat_map(|&config| simulate(&regions, &[config], &events, 4096));
        assert!(together.into_iter().eq(alone));
    }
}

#[test]
fn a_larger_lru_cache_never_misses_more_and_one_that_holds_everything_only_what_it_must() {
    let mut draw = Draw::new(4);
    for _ in 0..200 {
        let regions = random_regions(&mut draw);
        let mut events = random_events(&mut draw, &regions);
        // Compulsory fetches are all fetches of a large cache only if what warmed it up counts in neither.
        events.retain(|event| !matches!(event, Event::Block { .. }));
        let caches: Vec<CacheConfig> =
            [1, 2, 5, 30, 1000].map(|lines| CacheConfig::lru(lines * 64, Ways::Full, 64).unwrap()).to_vec();
        let rows = simulate(&regions, &caches, &events, 4096);
        assert!(rows.is_sorted_by(|a, b| a.fetches >= b.fetches && a.bytes_written_back >= b.bytes_written_back));
        assert_eq!(rows[4].fetches, rows[4].compulsory);
        assert!(rows.iter().all(|row| row.compulsory == rows[4].compulsory));
    }
}

#[test]
fn warm_up_fills_the_cache_and_counts_nowhere() {
    let regions = lay_out([("a".to_owned(), 4096, 64, Coding::Records)]);
    let configs = ["128,full,64,lru".parse().unwrap(), "none,64".parse().unwrap()];
    let write = |line: u64| Access { kind: AccessKind::Write, region: 0, len: 64, offset: 64 * line };
    let mut simulation = Simulation::new(&regions, &configs).unwrap();
    simulation.block(0, true);
    simulation.search(&[1, 2]);
    simulation.access(write(0));
    simulation.access(write(1));
    simulation.block(1, false);
    simulation.search(&[3, 4]);
    simulation.access(Access::read(0, 64, 64)); // hit, thanks to warm-up
    simulation.access(Access::read(0, 128, 64)); // evicts line 0, dirty from warm-up: not counted
    simulation.access(write(1)); // hit; turns dirty by a write that counts
    let rows = simulation.finish();
    let row = &rows[0];
    assert_eq!((row.searches, row.queries, row.records.reads, row.records.writes), (1, 2, 2, 1));
    assert_eq!((row.accesses, row.fetches, row.compulsory, row.bytes_written_back), (3, 1, 1, 64));
    // Without a cache, lines first touched in warm-up are no compulsory fetches either.
    assert_eq!((rows[1].fetches, rows[1].compulsory, rows[1].bytes_written_back), (2, 1, 64));
}

#[test]
fn no_cache_moves_records_as_they_are() {
    let regions = lay_out([("a".to_owned(), 1000, 20, Coding::Records), ("b".to_owned(), 24, 4, Coding::Records)]);
    let mut simulation = Simulation::new(&regions, &["none".parse().unwrap()]).unwrap();
    simulation.search(&[0]);
    simulation.access(Access::read(0, 120, 20));
    simulation.access(Access::read(0, 120, 20));
    simulation.access(Access { kind: AccessKind::Write, region: 1, len: 4, offset: 0 });
    simulation.access(Access { kind: AccessKind::ReadModifyWrite, region: 1, len: 4, offset: 20 });
    let row = simulation.finish().remove(0);
    assert_eq!((row.fetches, row.region_fetches.clone()), (3, vec![2, 1]));
    assert_eq!((row.bytes_fetched, row.bytes_written_back, row.raw_bytes()), (44, 8, 52));
    // Records 120..140 span lines 0 and 1; region b is one more line; 1,024 bytes are 8 blocks of 128.
    assert_eq!((row.accesses, row.compulsory, row.blocks), (6, 3, 8));
    assert_eq!((row.fetches_per_block(), row.reads_per_query()), (3.0 / 8.0, 2.0));
}

#[test]
fn the_first_access_may_be_to_address_zero() {
    // Two well-known simulators took zero, as a time or as a tag, for "nothing yet".
    let regions = [Region { name: "a".into(), base: 0, size: 4096, record_size: 4, coding: Coding::Records }];
    for config in ["4,full,4,lru", "64,full,4,lru", "64,1,4,lru", "64,4,4,lru"] {
        let config = config.parse().unwrap();
        let mut simulation = Simulation::new(&regions, &[config]).unwrap();
        for offset in [0, 0, 0] {
            simulation.access(Access::read(0, offset, 4));
        }
        let row = simulation.finish().remove(0);
        assert_eq!((row.accesses, row.fetches, row.compulsory), (3, 1, 1), "{config}");
    }
}

#[test]
fn an_empty_trace_is_rows_of_nothing() {
    let configs = ["128K,full,128,lru", "none", "1K,2,64,lru"].map(|c| c.parse().unwrap());
    for regions in [vec![], lay_out([("a".to_owned(), 0, 20, Coding::Records)])] {
        let rows = Simulation::new(&regions, &configs).unwrap().finish();
        assert_eq!(rows.len(), 3);
        for (row, config) in rows.iter().zip(configs) {
            assert_eq!(row.config, config);
            assert_eq!((row.fetches, row.blocks, row.bytes_fetched, row.compulsory), (0, 0, 0, 0));
            assert!(row.fetches_per_query().is_nan() && row.fetches_per_block().is_nan());
        }
    }
    let none: [CacheConfig; 0] = [];
    assert!(Simulation::new(&lay_out([]), &none).unwrap().finish().is_empty());
}

#[test]
fn regions_that_cannot_be_simulated_are_refused() {
    let config = [CacheConfig::lru(4, Ways::Full, 4).unwrap()];
    assert_eq!(config[0].policy().to_string(), "lru");
    let region = |base, size| Region { name: "a".into(), base, size, record_size: 4, coding: Coding::Records };
    let refusal = |regions: &[Region]| Simulation::new(regions, &config).err().unwrap().to_string();
    assert!(refusal(&[region(0, 1 << 40)]).contains("274877906944 lines of 4 bytes"));
    assert!(refusal(&[region(4096, 1 << 63), region(u64::MAX - 4095, 4097)]).contains("region 1"));
}

#[test]
#[should_panic(expected = "outside of its region")]
fn an_access_outside_of_its_region_is_not_taken_for_another_line() {
    let regions = lay_out([("a".to_owned(), 100, 20, Coding::Records)]);
    let mut simulation = Simulation::new(&regions, &["none".parse().unwrap()]).unwrap();
    simulation.access(Access::read(0, 90, 20));
    let _ = simulation.finish();
}

#[test]
fn records_told_together_count_as_one_by_one() {
    let mut draw = Draw::new(9);
    for case in 0..300 {
        // A region of more than 4 GiB as well, in front of or behind one of few records.
        let sizes = draw.pick(&[[2_000, 5 << 30], [5 << 30, 2_000], [70_000, 2_000]]);
        let size = draw.pick(&[1, 4, 20, 32, 100, 300]) as u32;
        let regions = lay_out(sizes.map(|bytes| ("map".to_owned(), bytes, 1, Coding::Records)));
        let configs: Vec<CacheConfig> =
            ["1K,full,64,lru", "4K,4,128,fifo", "none"].iter().map(|text| text.parse().unwrap()).collect();
        let chunk = draw.pick(&[1, 5, 60, 2048]) as usize;
        let simulation = || Simulation::in_chunks(&regions, &configs, &Measures::default(), chunk).unwrap();
        let (mut together, mut one_by_one) = (simulation(), simulation());
        for _ in 0..draw.below(12) {
            let region = draw.below(2);
            let last = (regions[region as usize].size / u64::from(size)).min(1 << 32) - 1;
            let near = draw.below(last + 1);
            let record = |draw: &mut Draw| (near + draw.below(200)).min(last) as u32;
            let records: Vec<u32> = (0..draw.below(3000)).map(|_| record(&mut draw)).collect();
            let warm_up = draw.below(4) == 0;
            for simulation in [&mut together, &mut one_by_one] {
                simulation.block(0, warm_up);
                simulation.search(&[0]);
            }
            together.records(region as u16, size, &records);
            for &record in &records {
                one_by_one.access(Access::read(region as u16, u64::from(record) * u64::from(size), size));
            }
            together.search_end();
            one_by_one.search_end();
        }
        assert_eq!(together.finish(), one_by_one.finish(), "case {case}");
    }
}
