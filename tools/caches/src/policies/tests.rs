//! What is particular about each policy, and the trials of all.

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink as _, lay_out};

use super::*;
use crate::trial::{self, Cost, Draw, Event, random_events, random_regions, simulate};
use crate::{CacheConfig, Simulation};

/// Reads the lines named by letters (A is line 0) and says which of them missed.
fn story(cache: &str, reads: &str) -> String {
    let regions = [Region { name: "a".into(), base: 0, size: 4096, record_size: 4, coding: Coding::Records }];
    let config: CacheConfig = cache.parse().unwrap();
    let fetches = |letters: &str| {
        let line = |letter: u8| u64::from(letter - b'A') * u64::from(config.line_bytes());
        let events: Vec<Event> = letters.bytes().map(|l| Event::Access(Access::read(0, line(l), 4))).collect();
        simulate(&regions, &[config], &events, 2048)[0].fetches
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
    let mut draw = Draw::new(15);
    let regions = lay_out([("a".to_owned(), 64 * 64, 64, Coding::Records)]);
    let events: Vec<Event> = (0..5000).map(|_| Event::Access(Access::read(0, draw.below(64) * 64, 64))).collect();
    let fetches = |seed: &str| {
        let config = format!("2K,full,64,random{seed}").parse().unwrap();
        simulate(&regions, &[config], &events, 2048)[0].fetches
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

/// A test each, so that what fails has a name.
macro_rules! trials {
    ($($trial:ident),* $(,)?) => { $( #[test] fn $trial() { trial::$trial(&policies()); } )* };
}

trials! {
    words_are_read_as_they_are_printed,
    the_first_access_may_be_to_address_zero,
    counts_are_those_of_the_definition,
    fetches_are_told_as_they_happen,
    repeats_are_left_out_only_where_they_do_not_matter,
    chunks_one_after_another_are_the_whole,
    a_cache_does_not_depend_on_those_beside_it,
    what_is_said_to_be_forgotten_is_forgotten,
    counts_add_up,
    no_policy_fetches_less_than_the_optimum,
    where_there_is_no_choice_all_are_one,
    a_cache_of_one_set_is_full,
}

#[test]
fn two_ways_of_a_tree_are_lru() {
    let mut draw = Draw::new(13);
    for _ in 0..300 {
        let regions = random_regions(&mut draw);
        let events = random_events(&mut draw, &regions);
        for (size, hash) in [(128, ""), (2048, ""), (2048, ",hash")] {
            let pair = ["lru", "plru"].map(|policy| format!("{size},2,64,{policy}{hash}").parse().unwrap());
            let costs: Vec<Cost> = simulate(&regions, &pair, &events, 2048).iter().map(Cost::of).collect();
            assert_eq!(costs[0], costs[1], "{size}{hash}");
        }
    }
}

#[test]
fn the_readme_has_the_table_of_policies() {
    let readme = include_str!("../../README.md");
    assert!(readme.contains(&policies().table()), "tools/caches/README.md should have:\n{}", policies().table());
}
