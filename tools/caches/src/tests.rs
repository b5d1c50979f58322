//! Do the counts agree with what can be known otherwise?

mod optimum;
mod policies;

use std::collections::{BTreeMap, BTreeSet};

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink, lay_out};

use super::{CacheConfig, Measures, Policy, Row, Simulation, Ways};

/// What a trace replays.
#[derive(Clone, Debug)]
pub(super) enum Event {
    Block { warm_up: bool },
    Search(Vec<u32>),
    Access(Access),
}

/// Small random numbers, the same on every run (splitmix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % n
    }

    pub(super) fn pick<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.below(of.len() as u64) as usize].clone()
    }
}

pub(super) fn replay(events: &[Event], sink: &mut dyn TraceSink) {
    for event in events {
        match event {
            Event::Block { warm_up } => sink.block(0, *warm_up),
            Event::Search(destinations) => sink.search(destinations),
            Event::Access(access) => sink.access(*access),
        }
    }
}

fn simulate(regions: &[Region], configs: &[CacheConfig], events: &[Event], chunk: usize) -> Vec<Row> {
    let mut simulation = Simulation::with_chunk(regions, configs, &Measures::default(), chunk).unwrap();
    replay(events, &mut simulation);
    simulation.finish()
}

/// The oracle: a cache as a list of lines, most recent first, in the plainest way there is.
pub(super) fn oracle(regions: &[Region], config: CacheConfig, events: &[Event]) -> Row {
    let line_bytes = u64::from(config.line_bytes());
    let sets = match config.ways() {
        Ways::Full => 1,
        Ways::N(ways) => config.lines() / u64::from(ways.get()),
    };
    let mut lists: BTreeMap<u64, Vec<(u64, bool)>> = BTreeMap::new();
    let mut touched = BTreeSet::new();
    let mut row = Row {
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

pub(super) fn random_regions(random: &mut Random) -> Vec<Region> {
    let mut regions = lay_out((0..random.below(4) + 1).map(|i| {
        let size = random.pick(&[1, 40, 500, 4096, 9000, 20_000]);
        (format!("region {i}"), size, 20, Coding::Records)
    }));
    // Anywhere in the address space, the very beginning included.
    let shift = random.pick(&[0, 4096, 1 << 40]);
    regions.iter_mut().for_each(|r| r.base = r.base - 4096 + shift);
    regions
}

pub(super) fn random_events(random: &mut Random, regions: &[Region]) -> Vec<Event> {
    let writes = random.below(2) == 0;
    let longest = random.pick(&[1, 20, 20, 300]);
    let warm_ups = random.below(2) == 0;
    // How far an access may be from the one before: loops, walks and leaps.
    let leap = random.pick(&[1, 50, 2000, 20_000]);
    let mut at = 0;
    let mut events = Vec::new();
    for _ in 0..random.below(400) {
        match random.below(20) {
            0 => events.push(Event::Block { warm_up: warm_ups && random.below(2) == 0 }),
            1 => events.push(Event::Search((0..random.below(3) as u32).collect())),
            _ => {
                let region = random.below(regions.len() as u64) as u16;
                let size = regions[region as usize].size;
                at = (at + random.below(leap)) % size;
                let len = (random.below(longest + 1)).min(size - at) as u32;
                let kind = match random.below(8) {
                    0 if writes => AccessKind::Write,
                    1 if writes => AccessKind::ReadModifyWrite,
                    _ => AccessKind::Read,
                };
                events.push(Event::Access(Access { kind, region, len, offset: at }));
            }
        }
    }
    events
}

fn random_configs(random: &mut Random) -> Vec<CacheConfig> {
    (0..random.below(8) + 1)
        .map(|_| {
            let line = random.pick(&[4, 16, 128, 128, 8192]);
            let ways = random.pick(&[0, 0, 1, 2, 3, 8]);
            let lines = match ways {
                0 => random.pick(&[1, 2, 3, 7, 20, 64, 100_000]),
                _ => ways << random.below(5),
            };
            let ways = std::num::NonZeroU32::new(ways as u32).map_or(Ways::Full, Ways::N);
            CacheConfig::lru(lines * u64::from(line), ways, line).unwrap()
        })
        .collect()
}

#[test]
fn every_count_is_that_of_a_plain_list() {
    let mut random = Random(1);
    for case in 0..3000 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let configs = random_configs(&mut random);
        let chunk = random.pick(&[1, 2, 5, 60, 4096]);
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
    let mut random = Random(2);
    let regions = lay_out([("map".to_owned(), 64_000, 20, Coding::Records)]);
    let mut events = Vec::new();
    for search in 0..300 {
        let around = if search / 50 % 2 == 0 { random.below(3000) } else { search * 4 };
        for _ in 0..300 {
            let record = (around + random.below(100) * random.below(3)).min(3199);
            let record = if random.below(3) == 0 { record >> random.below(12) } else { record };
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
    let mut random = Random(3);
    for _ in 0..200 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let mut configs = random_configs(&mut random);
        configs.push(CacheConfig::none(16).unwrap());
        configs.extend(random_configs(&mut random));
        let together = simulate(&regions, &configs, &events, 4096);
        let alone = configs.iter().flat_map(|&config| simulate(&regions, &[config], &events, 4096));
        assert!(together.into_iter().eq(alone));
    }
}

#[test]
fn a_larger_lru_cache_never_misses_more_and_one_that_holds_everything_only_what_it_must() {
    let mut random = Random(4);
    for _ in 0..200 {
        let regions = random_regions(&mut random);
        let mut events = random_events(&mut random, &regions);
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

/// Reads the lines named by letters (A is line 0) and says which of them missed.
fn story(cache: &str, reads: &str) -> String {
    let regions = [Region { name: "a".into(), base: 0, size: 4096, record_size: 4, coding: Coding::Records }];
    let config: CacheConfig = cache.parse().unwrap();
    let fetches = |letters: &str| {
        let line = |letter: u8| u64::from(letter - b'A') * u64::from(config.line_bytes());
        let events: Vec<Event> = letters.bytes().map(|l| Event::Access(Access::read(0, line(l), 4))).collect();
        simulate(&regions, &[config], &events, 4096)[0].fetches
    };
    let missed = |&i: &usize| fetches(&reads[..=i]) > fetches(&reads[..i]);
    (0..reads.len()).filter(missed).map(|i| &reads[i..=i]).collect()
}

#[test]
fn stories_of_lru() {
    // The one line there is holds only what was last read.
    assert_eq!(story("4,full,4,lru", "AABAAB"), "ABAB");
    // C evicts B, since A was read again; a list in order of arrival would evict A.
    assert_eq!(story("8,full,4,lru", "ABACAB"), "ABCB");
    // A loop of one line more than fits never hits; of as many as fit, always.
    assert_eq!(story("12,full,4,lru", "ABCDABCDABCD"), "ABCDABCDABCD");
    assert_eq!(story("16,full,4,lru", "ABCDABCDABCD"), "ABCD");
    // A to L: the four last read stay.
    assert_eq!(story("16,full,4,lru", "ABCDEFGHIJKLIJKLHIJKL"), "ABCDEFGHIJKLHIJKL");
}

#[test]
fn stories_of_sets() {
    // Direct-mapped, two sets: A and C are in each other's way, B is not.
    assert_eq!(story("8,1,4,lru", "ABCABCAB"), "ABCACA");
    // Two sets of two: A, C, E share one; C is older than A when E comes.
    assert_eq!(story("16,2,4,lru", "ACAEABCDE"), "ACEBCDE");
    // Three ways, two sets.
    assert_eq!(story("24,3,4,lru", "ACEAGCBDFB"), "ACEGCBDF");
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
    assert_eq!(config[0].policy(), Policy::Lru);
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
