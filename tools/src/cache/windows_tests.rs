//! Windows against the whole: what counts in a window is what a search costs in a cache that never began anew.

use std::collections::BTreeSet;

use pm_formats::trace::{Access, AccessKind, Coding, Region, TraceSink, lay_out};

use super::{CacheConfig, Counts, Measures, WindowedRow, Windows};
use crate::random::Random;

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
fn simulate(searches: &[Vec<Access>], windows: &[Window], chosen: u64, share: f64) -> Vec<WindowedRow> {
    let mut sink =
        Windows::new(&regions(), &caches(), &Measures { working_sets: true, ..Measures::default() }).unwrap();
    for (batch, (warm_up, measured)) in (0..).zip(windows) {
        for (range, is_warm_up) in [(warm_up, true), (measured, false)] {
            // In blocks of three.
            for block in searches[range.clone()].chunks(3) {
                sink.block(batch, is_warm_up);
                for search in block {
                    sink.search(&[1, 2]);
                    search.iter().for_each(|&access| sink.access(access));
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

fn fetches(counts: &Counts) -> u64 {
    counts.row.fetches
}

#[test]
fn after_warm_up_each_window_costs_what_it_costs_in_the_whole() {
    let searches = searches(3000, 1);
    for warm_up in [3, 10, 40, 200] {
        let windows: Vec<Window> = (1..14).map(|i| (i * 200 - warm_up..i * 200, i * 200..i * 200 + 30)).collect();
        let rows = simulate(&searches, &windows, 13, 0.1);
        for (row, cache) in rows.iter().zip(caches()) {
            let truth = truth(&searches, &cache);
            let (mut exact, mut expected) = (0, 0);
            for (warm_up, measured) in &windows {
                let lists = (cache.lines() > 0).then(|| Lists::new(&cache));
                if lists.is_none_or(|lists| lists.are_filled_by(&searches[warm_up.clone()])) {
                    exact += 1;
                    expected += truth[measured.clone()].iter().sum::<u64>();
                }
            }
            assert_eq!((row.windows(), row.windows_inexact()), (13, 13 - exact), "{cache} {warm_up}");
            assert_eq!(row.queries_measured(), exact * 60, "{cache} {warm_up}");
            assert_eq!(row.queries_simulated, 13 * 2 * (30 + warm_up as u64));
            let fetched = row.per_query(fetches);
            if exact > 0 {
                assert!((fetched.value - expected as f64 / (exact * 60) as f64).abs() < 1e-12, "{cache} {warm_up}");
            } else {
                assert!(fetched.value.is_nan() && fetched.half_width.is_nan());
            }
        }
        // Short warm-up fills none of them, long warm-up all.
        assert!(warm_up != 3 || rows[1].windows_inexact() == 13);
        assert!(warm_up != 200 || rows.iter().all(|row| row.windows_inexact() == 0));
    }
}

#[test]
fn without_warm_up_counting_begins_where_the_state_is_exact() {
    let searches = searches(3000, 2);
    let windows: Vec<Window> = (0..10).map(|i| (0..0, i * 300 + 7..i * 300 + 107)).collect();
    for (row, cache) in simulate(&searches, &windows, 10, 0.3).iter().zip(caches()) {
        let truth = truth(&searches, &cache);
        let (mut queries, mut expected, mut inexact) = (0, 0, 0);
        for (_, window) in &windows {
            let lists = Lists::new(&cache);
            let filled = |&at: &usize| cache.lines() == 0 || lists.are_filled_by(&searches[window.start..at]);
            match window.clone().find(filled) {
                Some(from) => {
                    queries += 2 * (window.end - from) as u64;
                    expected += truth[from..window.end].iter().sum::<u64>();
                }
                None => inexact += 1,
            }
        }
        assert_eq!((row.queries_measured(), row.windows_inexact()), (queries, inexact), "{cache}");
        assert!((row.per_query(fetches).value * queries as f64 - expected as f64).abs() < 1e-6, "{cache}");
        // What is not measured counts for the queries there are.
        assert!((row.total_queries().value - 10.0 * 200.0 / 0.3).abs() < 1e-6);
        let lines = row.ratio(|counts| counts.search_lines.unwrap(), |counts| counts.row.searches);
        assert!(lines.value > 1.0 && lines.value < 30.0);
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
    for (last, inexact) in [(1200 + 249, 0), (1200 + 248, 1)] {
        let mut sink = Windows::new(&regions(), &[cache], &Measures::default()).unwrap();
        for (search, warm_up) in searches.iter().zip([true, false, false]) {
            sink.block(0, warm_up);
            sink.search(&[0]);
            search.iter().take(last).for_each(|&access| sink.access(access));
        }
        let row = sink.finish(None, None).swap_remove(0);
        assert_eq!((row.windows_inexact(), row.queries_measured()), (inexact, 2 - 2 * inexact));
        assert!(inexact == 1 || row.per_query(fetches).value == 0.0);
        assert!(row.total(fetches).value.is_nan(), "no share is known");
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
    let all = run(&[0, 1, 2, 3, 4, 5], 6);
    let two_empty = run(&[0, 1, 3, 5], 6);
    assert_eq!((all.windows(), two_empty.windows(), two_empty.windows_inexact()), (6, 6, 0));
    assert_eq!(two_empty.queries_measured(), 40);
    assert!((two_empty.total_queries().value - 80.0).abs() < 1e-9);
    // Pairs (10, 10), (0, 10), (0, 10) of queries over the share.
    let expected = (2.0 * 20.0 * 20.0_f64).sqrt();
    let spread = crate::statistics::Spread::of_sum(&[20.0, 20.0, 0.0, 20.0, 0.0, 20.0]);
    assert!((spread.variance.sqrt() - expected).abs() < 1e-9);
    assert!((two_empty.total_queries().half_width - spread.half_width()).abs() < 1e-9);
    // Batches that number something else, and more of them than were chosen.
    assert_eq!(run(&[3, 7, 20], 6).windows(), 6);
    assert_eq!(run(&[3, 7, 20], 2).windows(), 3);
}

#[test]
fn a_total_is_off_by_what_its_windows_differ() {
    // Of windows that all measure all their queries, a total is their sum over the share.
    let searches = searches(3000, 4);
    let windows: Vec<Window> = (1..15).map(|i| (i * 200 - 100..i * 200, i * 200..i * 200 + 30 + i % 4)).collect();
    for (row, cache) in simulate(&searches, &windows, 14, 0.25).iter().zip(caches()) {
        let truth = truth(&searches, &cache);
        let sums: Vec<f64> =
            windows.iter().map(|(_, measured)| truth[measured.clone()].iter().sum::<u64>() as f64 / 0.25).collect();
        let total = row.total(fetches);
        assert_eq!(row.windows_inexact(), 0);
        assert!((total.value / sums.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{cache}");
        let spread = crate::statistics::Spread::of_sum(&sums);
        assert!((total.half_width / spread.half_width() - 1.0).abs() < 1e-9, "{cache}");
    }
}

#[test]
fn only_lru_and_none_have_a_state_that_is_known() {
    for policy in ["fifo", "clock", "random", "plru", "min", "min-bypass"] {
        let cache = format!("4K,4,64,{policy}").parse().unwrap();
        let error = Windows::new(&regions(), &[cache], &Measures::default()).err().expect("an error");
        assert!(error.to_string().contains("choose lru or none"), "{error}");
    }
}
