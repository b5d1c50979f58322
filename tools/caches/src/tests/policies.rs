//! Does every policy count what the plainest cache of that policy does?

use std::{collections::BTreeMap, num::NonZeroU32};

use super::*;
use crate::SetIndex;

/// All policies of sets and ways.
pub(super) const POLICIES: [Policy; 8] = [
    Policy::Lru,
    Policy::Fifo,
    Policy::Clock,
    Policy::Random { seed: 0 },
    Policy::Random { seed: 7 },
    Policy::TreePlru,
    Policy::Min,
    Policy::MinBypass,
];

/// An access to one line.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineAccess {
    pub(super) line: u64,
    writes: bool,
    counted: bool,
    region: usize,
}

/// The line accesses of a trace.
pub(super) fn line_accesses(regions: &[Region], line_bytes: u64, events: &[Event]) -> Vec<LineAccess> {
    let (mut accesses, mut counted) = (Vec::new(), true);
    for event in events {
        match event {
            Event::Block { warm_up } => counted = !warm_up,
            Event::Search(_) => {}
            Event::Access(access) => {
                let first = regions[access.region as usize].base + access.offset;
                let last = first + u64::from(access.len.max(1)) - 1;
                let (writes, region) = (access.kind != AccessKind::Read, access.region as usize);
                let lines = first / line_bytes..=last / line_bytes;
                accesses.extend(lines.map(|line| LineAccess { line, writes, counted, region }));
            }
        }
    }
    accesses
}

/// The set of a line: bit i of its number is the parity of the bits i, i + b, i + 2b, ... of the line.
pub(super) fn set_of(line: u64, sets: u64, index: SetIndex) -> u64 {
    let bits = sets.trailing_zeros() as usize;
    match index {
        SetIndex::Plain => line % sets,
        SetIndex::Hash => {
            (0..bits).map(|i| (i..64).step_by(bits).fold(0, |parity, bit| parity ^ line >> bit & 1) << i).sum()
        }
    }
}

/// What a cache costs: fetches by region, compulsory fetches, write-backs.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Cost {
    pub(super) fetches: Vec<u64>,
    compulsory: u64,
    write_backs: u64,
}

impl Cost {
    pub(super) fn of(row: &Row) -> Self {
        let write_backs = row.bytes_written_back / u64::from(row.config.line_bytes());
        Self { fetches: row.region_fetches.clone(), compulsory: row.compulsory, write_backs }
    }

    /// All fetches.
    fn total(&self) -> u64 {
        self.fetches.iter().sum()
    }
}

/// A line in its place.
#[derive(Clone, Copy)]
struct Held {
    line: u64,
    dirty: bool,
    came: usize,
    used: usize,
    /// Used since the hand of the clock passed.
    marked: bool,
}

/// A set in the plainest way there is: places in order, all of them searched.
#[derive(Default)]
struct NaiveSet {
    places: Vec<Held>,
    hand: usize,
    /// Ways in the half of the tree that was used last, by the range of ways that the node spans.
    last_half: BTreeMap<(usize, usize), usize>,
}

impl NaiveSet {
    /// Remembers at each node of the tree which half way `way` is in.
    fn climb(&mut self, ways: usize, way: usize) {
        let (mut from, mut to) = (0, ways);
        while to - from > 1 {
            let middle = (from + to) / 2;
            let half = usize::from(way >= middle);
            self.last_half.insert((from, to), half);
            (from, to) = if half == 0 { (from, middle) } else { (middle, to) };
        }
    }

    /// The way the tree points to: never into the half used last.
    fn pointed_to(&self, ways: usize) -> usize {
        let (mut from, mut to) = (0, ways);
        while to - from > 1 {
            let middle = (from + to) / 2;
            (from, to) = if self.last_half[&(from, to)] == 1 { (from, middle) } else { (middle, to) };
        }
        from
    }
}

/// When `line` is next accessed after `now`; a time after all if never.
fn next_use(accesses: &[LineAccess], now: usize, line: u64) -> usize {
    let later = accesses[now + 1..].iter().position(|access| access.line == line);
    later.map_or(usize::MAX, |steps| now + 1 + steps)
}

/// The oracle for one cache.
pub(super) fn naive(config: CacheConfig, regions: usize, accesses: &[LineAccess]) -> Cost {
    naive_misses(config, regions, accesses).0
}

/// The same, and region and line of each fetch in order, those of the warm-up too.
fn naive_misses(config: CacheConfig, regions: usize, accesses: &[LineAccess]) -> (Cost, Vec<(u16, u64)>) {
    let sets = config.sets();
    let ways = (config.lines() / sets) as usize;
    let mut caches: BTreeMap<u64, NaiveSet> = BTreeMap::new();
    let mut touched = BTreeSet::new();
    let mut cost = Cost { fetches: vec![0; regions], ..Cost::default() };
    let mut misses = vec![];
    let seed = if let Policy::Random { seed } = config.policy() { seed } else { 0 };
    let mut numbers = pm_random::Random::new(&[seed]);
    let bypass = config.policy() == Policy::MinBypass;
    // The line at hand, if it passes the cache by, and whether it is dirty.
    let mut at_hand: Option<(u64, bool)> = None;
    for (now, &LineAccess { line, writes, counted, region }) in accesses.iter().enumerate() {
        let cache = caches.entry(set_of(line, sets, config.index())).or_default();
        let first = touched.insert(line);
        if let Some((held, dirty)) = &mut at_hand {
            if *held == line {
                *dirty |= writes && counted;
                continue;
            }
            cost.write_backs += u64::from(*dirty);
            at_hand = None;
        }
        let way = if let Some(way) = cache.places.iter().position(|held| held.line == line) {
            way
        } else {
            misses.push((region as u16, line));
            cost.fetches[region] += u64::from(counted);
            cost.compulsory += u64::from(counted && first);
            let new = Held { line, dirty: false, came: now, used: now, marked: true };
            if cache.places.len() < ways {
                cache.places.push(new);
                cache.places.len() - 1
            } else {
                let by = |key: &dyn Fn(&Held) -> usize| (0..ways).min_by_key(|&way| key(&cache.places[way])).unwrap();
                let next = |held: &Held| next_use(accesses, now, held.line);
                let victim = match config.policy() {
                    Policy::None => unreachable!(),
                    Policy::Lru => by(&|held| held.used),
                    Policy::Fifo => by(&|held| held.came),
                    Policy::Clock => loop {
                        let way = cache.hand;
                        cache.hand = (cache.hand + 1) % ways;
                        if !cache.places[way].marked {
                            break way;
                        }
                        cache.places[way].marked = false;
                    },
                    Policy::Random { .. } => (u128::from(numbers.next_u64()) * ways as u128 / (1 << 64)) as usize,
                    Policy::TreePlru => cache.pointed_to(ways),
                    Policy::Min | Policy::MinBypass => by(&|held| usize::MAX - next(held)),
                };
                // Of consecutive accesses to the line, only what comes after them matters.
                let after = accesses[now..].iter().position(|access| access.line != line).map_or(now, |n| now + n - 1);
                if bypass && next_use(accesses, after, line) >= next(&cache.places[victim]) {
                    at_hand = Some((line, writes && counted));
                    continue;
                }
                cost.write_backs += u64::from(cache.places[victim].dirty);
                cache.places[victim] = new;
                victim
            }
        };
        let held = &mut cache.places[way];
        held.dirty |= writes && counted;
        (held.used, held.marked) = (now, true);
        cache.climb(ways, way);
    }
    let left = caches.values().flat_map(|cache| &cache.places).filter(|held| held.dirty).count();
    cost.write_backs += left as u64 + u64::from(at_hand.is_some_and(|(_, dirty)| dirty));
    (cost, misses)
}

/// A cache of any kind but none.
pub(super) fn random_cache(random: &mut Random, policy: Policy) -> CacheConfig {
    let line = random.pick(&[4, 16, 128, 128, 8192]);
    let tree = policy == Policy::TreePlru;
    let ways = random.pick(if tree { &[0, 1, 2, 4, 8, 64] } else { &[0, 1, 2, 3, 8, 16, 37] });
    let lines = match ways {
        0 if tree => random.pick(&[1, 2, 4, 16, 64, 1 << 30]),
        0 => random.pick(&[1, 2, 3, 7, 20, 64, 1 << 30]),
        _ => ways << random.below(5),
    };
    let ways = NonZeroU32::new(ways).map_or(Ways::Full, Ways::N);
    let config = CacheConfig::new(u64::from(lines) * u64::from(line), ways, line, policy).unwrap();
    if ways != Ways::Full && random.below(2) == 0 { config.hashed().unwrap() } else { config }
}

#[test]
fn every_policy_counts_as_its_plainest_cache_does() {
    let mut random = Random(11);
    for case in 0..2000 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let configs: Vec<CacheConfig> = POLICIES.iter().map(|&policy| random_cache(&mut random, policy)).collect();
        let chunk = random.pick(&[1, 2, 5, 60, 4096]);
        for (row, &config) in simulate(&regions, &configs, &events, chunk).iter().zip(&configs) {
            let accesses = line_accesses(&regions, config.line_bytes().into(), &events);
            assert_eq!(Cost::of(row), naive(config, regions.len(), &accesses), "case {case}, {config}, chunk {chunk}");
            assert_eq!((row.config, row.fetches), (config, Cost::of(row).total()));
        }
    }
}

#[test]
fn every_policy_tells_which_lines_it_fetches_and_when() {
    let mut random = Random(16);
    let mut told = 0;
    for case in 0..400 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        for policy in POLICIES {
            let config = random_cache(&mut random, policy);
            // A second cache of the same lines: under LRU both are answered by one stack.
            let beside = CacheConfig::lru(8 * u64::from(config.line_bytes()), Ways::Full, config.line_bytes()).unwrap();
            let chunk = random.pick(&[1, 2, 5, 60, 4096]);
            let measures = Measures::default();
            let mut simulation = Simulation::with_chunk(&regions, &[config, beside], &measures, chunk).unwrap();
            simulation.keep_fetched();
            replay(&events, &mut simulation);
            let mut fetched = vec![];
            simulation.take_fetched(&mut fetched);
            let accesses = line_accesses(&regions, config.line_bytes().into(), &events);
            let (_, expected) = naive_misses(config, regions.len(), &accesses);
            assert_eq!(fetched, expected, "case {case}, {config}, chunk {chunk}");
            told += fetched.len();
        }
    }
    assert!(told > 100_000, "{told} fetches are no test");
}

#[test]
fn where_there_is_no_choice_all_policies_are_one() {
    let mut random = Random(12);
    for _ in 0..300 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        // One line in each set, one line in all, more lines than there are: nothing to choose from.
        for (lines, ways) in [(16, "1"), (1, "full"), (1, "1"), (1 << 12, "full"), (1 << 12, "8")] {
            let cache = |policy: &Policy| format!("{},{ways},64,{policy}", lines * 64).parse().unwrap();
            // Bypassing is a choice.
            let configs: Vec<CacheConfig> =
                POLICIES.iter().filter(|&&p| lines > 16 || p != Policy::MinBypass).map(cache).collect();
            let rows = simulate(&regions, &configs, &events, 4096);
            assert!(rows.iter().all(|row| Cost::of(row) == Cost::of(&rows[0])), "{lines} lines, {ways} ways: {rows:?}");
        }
    }
}

#[test]
fn as_many_ways_as_lines_are_a_full_cache_and_two_ways_of_a_tree_are_lru() {
    let mut random = Random(13);
    for _ in 0..300 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let costs = |caches: [String; 2]| {
            let rows = simulate(&regions, &caches.map(|cache| cache.parse().unwrap()), &events, 4096);
            rows.iter().map(Cost::of).collect::<Vec<_>>()
        };
        for policy in POLICIES {
            let pair = costs([format!("512,full,64,{policy}"), format!("512,8,64,{policy},hash")]);
            assert_eq!(pair[0], pair[1], "{policy}");
        }
        for (size, hash) in [(128, ""), (2048, ""), (2048, ",hash")] {
            let pair = costs([format!("{size},2,64,lru{hash}"), format!("{size},2,64,plru{hash}")]);
            assert_eq!(pair[0], pair[1], "{size}{hash}");
        }
    }
}

#[test]
fn a_trace_cut_into_chunks_is_the_same_trace() {
    let mut random = Random(14);
    for _ in 0..100 {
        let regions = random_regions(&mut random);
        let events = random_events(&mut random, &regions);
        let configs: Vec<CacheConfig> = POLICIES.iter().map(|&policy| random_cache(&mut random, policy)).collect();
        let whole = simulate(&regions, &configs, &events, 4096);
        for chunk in [1, 3, 64] {
            assert_eq!(simulate(&regions, &configs, &events, chunk), whole);
        }
    }
}

#[test]
fn the_first_access_may_be_to_address_zero_under_any_policy() {
    let regions = [Region { name: "a".into(), base: 0, size: 4096, record_size: 4, coding: Coding::Records }];
    for policy in POLICIES {
        for cache in ["4,full,4", "64,full,4", "64,1,4", "64,4,4"] {
            let config: CacheConfig = format!("{cache},{policy}").parse().unwrap();
            let events: Vec<Event> = [0, 0, 4, 0].map(|offset| Event::Access(Access::read(0, offset, 4))).into();
            let row = simulate(&regions, &[config], &events, 4096).remove(0);
            let once = config.lines() > 1 || policy == Policy::MinBypass;
            assert_eq!((row.accesses, row.fetches), (4, if once { 2 } else { 3 }), "{config}");
            assert_eq!(row.compulsory, 2, "{config}");
        }
    }
}

#[test]
fn stories_of_policies() {
    // Belady, Nelson and Shedler 1969: under FIFO the larger cache may miss more, here 10 times instead of 9.
    assert_eq!(story("12,full,4,fifo", "ABCDABEABCDE"), "ABCDABECD");
    assert_eq!(story("16,full,4,fifo", "ABCDABEABCDE"), "ABCDEABCDE");
    // A was used, but it came first: out it goes.
    assert_eq!(story("8,full,4,fifo", "ABACAB"), "ABCAB");
    // A line that comes in counts as used, so B has no less of a chance than A, which was used again.
    assert_eq!(story("8,full,4,clock", "ABACA"), "ABCA");
    // All were used when D comes, so the hand goes round and A, where it began, leaves. Then B is used again and so has a
    // second chance: E takes the place of C.
    assert_eq!(story("12,full,4,clock", "ABCDBEB"), "ABCDE");
    assert_eq!(story("12,full,4,clock", "ABCDBEC"), "ABCDEC");
    // B is the oldest when E comes, but A, which was used just before, is in the same half of the tree: C leaves.
    assert_eq!(story("16,full,4,plru", "ABCDAEDBC"), "ABCDEC");
    assert_eq!(story("16,full,4,lru", "ABCDAEDBC"), "ABCDEBC");
    // When D comes, C is used last of A, B and C, and so makes room; D itself, used later still, had better pass by.
    assert_eq!(story("12,full,4,min", "ABCDABCABCD"), "ABCDCD");
    assert_eq!(story("12,full,4,min-bypass", "ABCDABCABCD"), "ABCDD");
}

#[test]
fn seeds_are_what_random_eviction_depends_on() {
    let mut random = Random(15);
    let regions = lay_out([("a".to_owned(), 64 * 64, 64, Coding::Records)]);
    let events: Vec<Event> = (0..5000).map(|_| Event::Access(Access::read(0, random.below(64) * 64, 64))).collect();
    let fetches = |seed: &str| {
        let config = format!("2K,full,64,random{seed}").parse().unwrap();
        simulate(&regions, &[config], &events, 4096)[0].fetches
    };
    assert_eq!(fetches(""), fetches(":0"));
    assert_ne!(fetches(":1"), fetches(":2"));
    // Half of the lines are cached, and for accesses at random no policy is better or worse: half of the accesses miss, 2500
    // with a standard deviation of 35, and 16 more while the cache fills.
    for seed in 0..20 {
        assert!((2350..2680).contains(&fetches(&format!(":{seed}"))), "{seed}");
    }
}

#[test]
fn bytes_pass_32_bits() {
    let regions = [Region { name: "a".into(), base: 0, size: 1 << 34, record_size: 4, coding: Coding::Records }];
    let configs = ["2G,full,2G,fifo", "2G,full,2G,min", "none"].map(|cache| cache.parse().unwrap());
    let reads = (0..8).map(|i| Event::Access(Access::read(0, i << 31, u32::MAX >> 1)));
    let rows = simulate(&regions, &configs, &reads.collect::<Vec<_>>(), 4096);
    assert!(rows[..2].iter().all(|row| row.bytes_fetched == 8 << 31), "{rows:?}");
    assert_eq!(rows[2].bytes_fetched, 8 * ((1 << 31) - 1));
}

#[test]
#[ignore = "minutes: cargo test -p pm-caches --release --lib -- --ignored counters_pass_32_bits"]
fn counters_pass_32_bits() {
    // One record over 2^20 lines, 4097 times, is more than 2^32 line accesses, none of which hits in fewer lines.
    let regions = lay_out([("a".to_owned(), 4 << 20, 4, Coding::Records)]);
    let configs = ["4,full,4,lru", "4,full,4,fifo", "64,full,4,min", "none,4"].map(|cache| cache.parse().unwrap());
    let mut simulation = Simulation::new(&regions, &configs).unwrap();
    for _ in 0..4097 {
        simulation.access(Access { kind: AccessKind::Write, region: 0, len: 4 << 20, offset: 0 });
    }
    let rows = simulation.finish();
    let accesses = 4097 << 20;
    assert!(accesses > u64::from(u32::MAX));
    for row in &rows[..2] {
        assert_eq!((row.accesses, row.fetches, row.bytes_written_back), (accesses, accesses, 4 * accesses));
    }
    // The optimum keeps 15 lines: of the 2^20 - 1 others a round has, it has to fetch all but 15.
    let (round, kept) = (1 << 20, 15);
    let least = round + 4096 * round * (round - 1 - kept) / (round - 1);
    assert!(rows[2].fetches.abs_diff(least) <= 16, "{} fetches, {least} expected", rows[2].fetches);
    assert_eq!((rows[3].accesses, rows[3].bytes_written_back), (accesses, 4 * accesses));
}
