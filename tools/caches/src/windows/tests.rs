//! Windows against the whole: what counts in a window is what a search costs in a cache that never began anew.

use std::collections::BTreeSet;

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink, lay_out};

use super::{WindowCounts, WindowedCounts, Windows};
use crate::{CacheConfig, Measures, policies};
use pm_random::Random;
use pm_sampling::{Ratio, Spread};

/// Two arrays of records, one of which has some that span lines.
fn regions() -> Vec<Region> {
    lay_out([("nodes".to_owned(), 24_000, 20, Coding::Records), ("leaves".to_owned(), 9_000, 36, Coding::Records)])
}

/// Searches that wander: each reads and writes some records near the one before.
fn searches(number: usize, seed: u64) -> Vec<Vec<Access>> {
    let mut random = Random::new(&[seed]);
    let mut at = 0u64;
    (0..number)
        .map(|_| {
            at = if random.unit() < 0.05 { random.next_u64() % 1000 } else { (at + random.next_u64() % 9) % 1000 };
            let mut access = || {
                let near = (at + random.next_u64() % 40) % 1000;
                let kind = if random.unit() < 0.1 { AccessKind::ReadModifyWrite } else { AccessKind::Read };
                match random.unit() < 0.7 {
                    true => Access { kind, ..Access::read(0, near * 20, 20) },
                    false => Access { kind, ..Access::read(1, near % 250 * 36, 36) },
                }
            };
            (0..12).map(|_| access()).collect()
        })
        .collect()
}

/// Line numbers of an access.
fn lines(access: &Access, line: u64) -> impl Iterator<Item = u64> + use<> {
    let first = regions()[usize::from(access.region)].base + access.offset;
    first / line..=(first + u64::from(access.len) - 1) / line
}

/// LRU as it is defined: for each set a list, the line last used in front.
struct Lists {
    sets: Vec<Vec<u64>>,
    ways: usize,
    line: u64,
}

impl Lists {
    fn new(cache: &CacheConfig) -> Self {
        let ways = (cache.lines() / cache.sets()) as usize;
        Self { sets: vec![vec![]; cache.sets() as usize], ways, line: cache.line_bytes().into() }
    }

    /// Fetches of a search.
    fn search(&mut self, accesses: &[Access]) -> u64 {
        let mut fetches = 0;
        for line in accesses.iter().flat_map(|access| lines(access, self.line)) {
            let number = self.sets.len() as u64;
            let set = &mut self.sets[(line % number) as usize];
            match set.iter().position(|&held| held == line) {
                Some(at) => {
                    set.remove(at);
                }
                None => fetches += 1,
            }
            set.insert(0, line);
            set.truncate(self.ways);
        }
        fetches
    }

    /// Whether searches bring each set so many distinct lines that nothing from before is left.
    fn are_filled_by(&self, searches: &[Vec<Access>]) -> bool {
        let number = self.sets.len() as u64;
        let seen: BTreeSet<u64> = searches.iter().flatten().flat_map(|access| lines(access, self.line)).collect();
        // Each set has more lines in the map than ways.
        (0..number).all(|set| seen.iter().filter(|&line| line % number == set).count() >= self.ways)
    }
}

const CACHES: [&str; 5] = ["2K,full,64,lru", "4K,full,128,lru", "2K,4,64,lru", "1K,2,128,lru", "none"];

fn caches() -> Vec<CacheConfig> {
    CACHES.iter().map(|text| text.parse().unwrap()).collect()
}

/// A window: searches of warm-up, and those measured.
type Window = (std::ops::Range<usize>, std::ops::Range<usize>);

/// Simulates windows of `searches`, each search for two queries.
fn simulate(searches: &[Vec<Access>], windows: &[Window], chosen: u64, share: f64) -> Vec<WindowedCounts> {
    let one_by_one = |sink: &mut Windows, search: &[Access]| search.iter().for_each(|&access| sink.access(access));
    simulate_told(searches, windows, chosen, share, one_by_one)
}

/// The same, where `tell` says how accesses are told.
fn simulate_told(
    searches: &[Vec<Access>],
    windows: &[Window],
    chosen: u64,
    share: f64,
    tell: impl Fn(&mut Windows, &[Access]),
) -> Vec<WindowedCounts> {
    let mut sink =
        Windows::new(&regions(), &caches(), &Measures { working_sets: true, ..Measures::default() }).unwrap();
    for (batch, (warm_up, measured)) in (0..).zip(windows) {
        for (range, is_warm_up) in [(warm_up, true), (measured, false)] {
            // In blocks of three.
            for block in searches[range.clone()].chunks(3) {
                sink.block(batch, is_warm_up);
                for search in block {
                    sink.search(&[1, 2]);
                    tell(&mut sink, search);
                    sink.search_end();
                }
            }
        }
    }
    sink.finish(Some(chosen), Some(share))
}

/// What each search fetches in a cache that never began anew.
fn truth(searches: &[Vec<Access>], cache: &CacheConfig) -> Vec<u64> {
    if cache.lines() == 0 {
        return searches
            .iter()
            .map(|search| search.iter().filter(|a| a.kind != AccessKind::Write).count() as u64)
            .collect();
    }
    let mut lists = Lists::new(cache);
    searches.iter().map(|search| lists.search(search)).collect()
}

#[test]
fn accesses_count_alike_told_one_by_one_and_many_at_once() {
    let searches = searches(800, 4);
    let plain: Vec<Vec<Access>> = searches
        .iter()
        .map(|search| search.iter().map(|access| Access { kind: AccessKind::Read, ..*access }).collect())
        .collect();
    let windows: Vec<Window> = (1..6).map(|i| (i * 100..i * 100 + 9, i * 100 + 9..i * 100 + 40)).collect();
    let told = |counts: Vec<WindowedCounts>| format!("{counts:?}");
    let together = |sink: &mut Windows, search: &[Access]| sink.accesses(search);
    assert_eq!(told(simulate_told(&searches, &windows, 5, 0.1, together)), told(simulate(&searches, &windows, 5, 0.1)));
    let by_records = |sink: &mut Windows, search: &[Access]| {
        for run in search.chunk_by(|a, b| a.region == b.region) {
            let records: Vec<u32> =
                run.iter().map(|access| u32::try_from(access.offset / u64::from(access.len)).unwrap()).collect();
            sink.records(run[0].region, run[0].len, &records);
        }
    };
    let counts = simulate_told(&plain, &windows, 5, 0.1, by_records);
    assert!(told(counts) == told(simulate(&plain, &windows, 5, 0.1)), "as records of a region");
}

#[test]
fn after_warm_up_each_window_costs_what_it_costs_in_the_whole() {
    let searches = searches(3000, 1);
    for warm_up in [0, 3, 10, 40, 200] {
        let windows: Vec<Window> = (1..14).map(|i| (i * 200 - warm_up..i * 200, i * 200..i * 200 + 30)).collect();
        for (row, cache) in simulate(&searches, &windows, 13, 0.1).iter().zip(caches()) {
            let truth = truth(&searches, &cache);
            let mut inexact = 0;
            for ((warm_up, measured), counts) in windows.iter().zip(&row.windows) {
                let lists = Lists::new(&cache);
                let exact = cache.lines() == 0 || lists.are_filled_by(&searches[warm_up.clone()]);
                let expected = truth[measured.clone()].iter().sum::<u64>();
                assert_eq!(counts.exact, exact, "{cache} {warm_up:?}");
                let (most, unknown) = (counts.cache.fetches, counts.unknown_fetches());
                if exact {
                    assert_eq!((most, unknown), (expected, 0), "{cache} {warm_up:?}");
                } else {
                    inexact += 1;
                    // The truth lies between the bounds.
                    assert!((most - unknown..=most).contains(&expected), "{cache} {warm_up:?}");
                    assert!(unknown <= cache.lines());
                }
            }
            assert_eq!((row.windows.len(), row.windows_inexact()), (13, inexact));
            assert_eq!((row.queries_measured(), row.queries_simulated), (13 * 60, 13 * 2 * (30 + warm_up as u64)));
            let expected: u64 = windows.iter().map(|(_, measured)| truth[measured.clone()].iter().sum::<u64>()).sum();
            let (found, expected) = (row.fetches_per_query(), expected as f64 / (13.0 * 60.0));
            assert!((found.value - expected).abs() <= found.doubt + 1e-12, "{cache} {warm_up}");
            assert!(found.doubt == 0.0 || inexact > 0);
            // No warm-up fills none of them, long warm-up all.
            assert!(warm_up > 0 || inexact == 13 || cache.lines() == 0);
            assert!(warm_up < 200 || inexact == 0);
        }
    }
}

#[test]
fn what_is_unknown_is_each_line_first_seen_until_its_set_is_filled() {
    let searches = searches(60, 6);
    for (row, cache) in simulate(&searches, &[(0..1, 1..60)], 1, 1.0).iter().zip(caches()).take(4) {
        let (line, number) = (u64::from(cache.line_bytes()), cache.sets());
        let ways = (cache.lines() / number) as usize;
        let mut seen: Vec<BTreeSet<u64>> = vec![BTreeSet::new(); number as usize];
        let mut unknown = 0;
        for (i, search) in searches.iter().enumerate() {
            for line in search.iter().flat_map(|access| lines(access, line)) {
                let set = &mut seen[(line % number) as usize];
                unknown += u64::from(set.len() < ways && set.insert(line) && i >= 1);
            }
        }
        assert_eq!(row.windows[0].unknown_fetches(), unknown, "{cache}");
        // One search of 12 records, of two lines each at most, does not fill 32 lines.
        assert!(unknown > 0 || cache.lines() < 32);
    }
}

#[test]
fn a_cache_that_holds_all_is_exact_when_it_has_seen_all() {
    let all: Vec<Access> = (0..1200)
        .map(|record| Access::read(0, record * 20, 20))
        .chain((0..250).map(|record| Access::read(1, record * 36, 36)))
        .collect();
    let searches = [all.clone(), all[..10].to_vec(), all[20..30].to_vec()];
    let cache: CacheConfig = "1M,full,128,lru".parse().unwrap();
    // The last two records lie in the last line.
    for (last, exact) in [(1200 + 249, true), (1200 + 248, false)] {
        let mut sink = Windows::new(&regions(), &[cache], &Measures::default()).unwrap();
        for (search, warm_up) in searches.iter().zip([true, false, false]) {
            sink.block(0, warm_up);
            sink.search(&[0]);
            search.iter().take(last).for_each(|&access| sink.access(access));
        }
        let row = sink.finish(None, None).swap_remove(0);
        assert_eq!((row.windows[0].exact, row.queries_measured()), (exact, 2));
        assert_eq!((row.fetches_per_query().value, row.fetches_per_query().doubt), (0.0, 0.0));
        assert!(row.total(|counts| counts.cache.fetches, |_| 0).value.is_nan(), "no share is known");
    }
}

#[test]
fn windows_without_queries_count_as_zero_in_their_place() {
    let searches = searches(400, 3);
    let none = &caches()[4..];
    let run = |batches: &[u64], chosen| {
        let mut sink = Windows::new(&regions(), none, &Measures::default()).unwrap();
        for &batch in batches {
            sink.block(batch, false);
            for search in &searches[batch as usize * 10..][..10] {
                sink.search(&[0]);
                search.iter().for_each(|&access| sink.access(access));
            }
        }
        sink.finish(Some(chosen), Some(0.5)).swap_remove(0)
    };
    let queries = |row: &WindowedCounts| row.total(|counts| counts.cache.queries, |_| 0);
    let all = run(&[0, 1, 2, 3, 4, 5], 6);
    let two_empty = run(&[0, 1, 3, 5], 6);
    assert_eq!((all.windows.len(), two_empty.windows.len(), two_empty.windows_inexact()), (6, 6, 0));
    assert_eq!(two_empty.queries_measured(), 40);
    assert!((queries(&two_empty).value - 80.0).abs() < 1e-9);
    let spread = Spread::of_sum(&[20.0, 20.0, 0.0, 20.0, 0.0, 20.0]);
    assert!((queries(&two_empty).half_width() - spread.half_width()).abs() < 1e-9);
    // Batches that number something else, and more of them than were chosen.
    assert_eq!(run(&[3, 7, 20], 6).windows.len(), 6);
    assert_eq!(run(&[3, 7, 20], 2).windows.len(), 3);
}

#[test]
fn totals_and_ratios_are_off_by_what_windows_differ_and_what_is_unknown() {
    let searches = searches(3000, 4);
    let windows: Vec<Window> = (1..15).map(|i| (i * 200 - 12..i * 200, i * 200..i * 200 + 30 + i % 4)).collect();
    for (row, cache) in simulate(&searches, &windows, 14, 0.25).iter().zip(caches()) {
        let each = |number: fn(&WindowCounts) -> u64| -> Vec<f64> {
            row.windows.iter().map(|counts| number(counts) as f64).collect()
        };
        let (most, unknown) = (each(|counts| counts.cache.fetches), each(WindowCounts::unknown_fetches));
        let queries: Vec<f64> = windows.iter().map(|(_, measured)| 2.0 * measured.len() as f64).collect();

        let total = row.total(|counts| counts.cache.fetches, WindowCounts::unknown_fetches);
        assert_eq!(total, Ratio::total(&most, &unknown, 0.25), "{cache}");
        let ratio = row.fetches_per_query();
        assert_eq!(ratio, Ratio::between(&most, &unknown, &queries), "{cache}");
        let some = row.of_windows([2, 5, 11, 13]).fetches_per_query();
        let of = |all: &[f64]| [2, 5, 11, 13].map(|i: usize| all[i]);
        assert_eq!(some, Ratio::between(&of(&most), &of(&unknown), &of(&queries)), "{cache}");
    }
}

#[test]
fn only_lru_and_none_have_a_state_that_is_known() {
    let policies = policies();
    let known = policies.iter().filter(|policy| policy.forgets_what_was_before()).map(|policy| policy.word());
    assert_eq!(known.collect::<Vec<_>>(), ["lru", "none"]);
    for policy in policies.iter().filter(|policy| !policy.forgets_what_was_before()) {
        let cache = format!("4K,4,64,{}", policy.word()).parse().unwrap();
        let error = Windows::new(&regions(), &[cache], &Measures::default()).err().expect("an error");
        assert!(error.to_string().contains("choose lru or none"), "{error}");
    }
}
