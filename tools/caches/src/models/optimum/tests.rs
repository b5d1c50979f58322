//! Is Belady's optimum optimal, and the same however it is computed?

use std::collections::{BTreeMap, BTreeSet};

use pm_formats::trace::{Access, Coding, Region};

use crate::trial::{Draw, Event, LineAccess, line_accesses, set_of, simulate};
use crate::{CacheConfig, ChosenPolicy, SetIndex, Ways};

/// Lines by set, in order of access.
fn by_set(accesses: &[LineAccess], sets: u64, index: SetIndex) -> Vec<Vec<u64>> {
    let mut lists = vec![Vec::new(); sets as usize];
    accesses.iter().for_each(|access| lists[set_of(access.line, sets, index) as usize].push(access.line));
    lists
}

/// Misses of Belady's optimum for caches of 1, 2, ... lines, by the priority stack of Mattson, Gecsei, Slutz and Traiger
/// (1970): the first so many lines of it are what a cache holds.
fn mattson(lines: &[u64], sizes: usize) -> Vec<u64> {
    let mut misses = vec![0; sizes];
    let mut stack: Vec<(u64, usize)> = Vec::new();
    for (now, &line) in lines.iter().enumerate() {
        let next = lines[now + 1..].iter().position(|&l| l == line).map_or(usize::MAX, |n| now + 1 + n);
        let depth = stack.iter().position(|&(l, _)| l == line);
        misses.iter_mut().take(depth.unwrap_or(sizes)).for_each(|n| *n += 1);
        let end = depth.unwrap_or(stack.len());
        if end == stack.len() {
            stack.push((line, next));
        }
        // The line moves to the top; what was there sinks to where something with a later next use is, and so on.
        let mut carried = std::mem::replace(&mut stack[0], (line, next));
        for place in &mut stack[1..end.max(1)] {
            if carried.1 < place.1 {
                std::mem::swap(&mut carried, place);
            }
        }
        if end > 0 {
            stack[end] = carried;
        }
    }
    misses
}

/// Misses of the optimum where fetched lines may pass by, from how many frames are taken at each time (the occupancy of
/// Jain and Lin 2016): a line stays from one use to the next if at none of the times between all are taken.
fn occupancy(lines: &[u64], frames: u64) -> u64 {
    let mut taken = vec![0; lines.len()];
    let mut misses = 0;
    for (now, line) in lines.iter().enumerate() {
        match lines[..now].iter().rposition(|l| l == line) {
            Some(before) if taken[before..now].iter().all(|&n| n < frames) => {
                taken[before..now].iter_mut().for_each(|n| *n += 1);
            }
            _ => misses += 1,
        }
    }
    misses
}

/// Fetches by any choice of what to keep, the least possible: a search through all of them.
fn least(lines: &[u64], capacity: usize, bypass: bool) -> u64 {
    let mut costs: BTreeMap<BTreeSet<u64>, u64> = BTreeMap::from([(BTreeSet::new(), 0)]);
    for line in lines {
        let mut after: BTreeMap<BTreeSet<u64>, u64> = BTreeMap::new();
        let mut reach = |held: BTreeSet<u64>, cost| {
            let least = after.entry(held).or_insert(cost);
            *least = cost.min(*least);
        };
        for (held, cost) in costs {
            if held.contains(line) {
                reach(held, cost);
                continue;
            }
            let with = |mut held: BTreeSet<u64>| {
                held.insert(*line);
                held
            };
            if held.len() < capacity {
                reach(with(held.clone()), cost + 1);
            }
            for victim in &held {
                let mut rest = held.clone();
                rest.remove(victim);
                reach(with(rest), cost + 1);
            }
            if bypass {
                reach(held, cost + 1);
            }
        }
        costs = after;
    }
    costs.into_values().min().unwrap_or(0)
}

fn fetches(lines: &[u64], caches: &[CacheConfig]) -> Vec<u64> {
    let regions = [Region { name: "a".into(), base: 0, size: 4096, record_size: 4, coding: Coding::Records }];
    let events: Vec<Event> = lines.iter().map(|line| Event::Access(Access::read(0, line * 4, 4))).collect();
    simulate(&regions, caches, &events, 4096).iter().map(|row| row.fetches).collect()
}

/// Lines at random, no line twice in a row.
fn random_lines(draw: &mut Draw, most: u64, distinct: u64) -> Vec<u64> {
    let mut lines: Vec<u64> = (0..draw.below(most + 1)).map(|_| draw.below(distinct)).collect();
    lines.dedup();
    lines
}

#[test]
fn no_choice_of_lines_to_keep_fetches_less() {
    let mut draw = Draw::new(21);
    for _ in 0..2000 {
        let lines = random_lines(&mut draw, 14, 5);
        let (min, bypass): (ChosenPolicy, ChosenPolicy) = ("min".parse().unwrap(), "min-bypass".parse().unwrap());
        for capacity in 1..4 {
            let caches = [min, bypass].map(|p| CacheConfig::new(4 * capacity, Ways::Full, 4, p).unwrap());
            let least = [false, true].map(|bypass| least(&lines, capacity as usize, bypass));
            assert_eq!(fetches(&lines, &caches), least, "{lines:?}, {capacity} lines");
        }
    }
}

#[test]
fn mattsons_stack_and_occupancies_count_the_same() {
    let mut draw = Draw::new(22);
    for _ in 0..2000 {
        let distinct = draw.pick(&[3, 10, 40]);
        let lines = random_lines(&mut draw, 300, distinct);
        let sizes: Vec<u64> = (1..=20).collect();
        let caches = |policy: &str| -> Vec<CacheConfig> {
            sizes.iter().map(|n| format!("{},full,4,{policy}", n * 4).parse().unwrap()).collect()
        };
        assert_eq!(fetches(&lines, &caches("min")), mattson(&lines, sizes.len()), "{lines:?}");
        let expected: Vec<u64> = sizes.iter().map(|&n| occupancy(&lines, n)).collect();
        assert_eq!(fetches(&lines, &caches("min-bypass")), expected, "{lines:?}");
    }
}

#[test]
fn the_curve_of_the_optimum_is_convex() {
    // Michaud, *Some Mathematical Facts About Optimal Cache Replacement*, TACO 2016.
    let mut draw = Draw::new(23);
    for _ in 0..500 {
        let lines = random_lines(&mut draw, 1000, 40);
        let caches: Vec<CacheConfig> = (1..=40).map(|n| format!("{},full,4,min", n * 4).parse().unwrap()).collect();
        let misses = fetches(&lines, &caches);
        assert!(misses.windows(3).all(|n| n[0] + n[2] >= 2 * n[1]), "{misses:?}");
    }
}

#[test]
fn each_set_is_an_optimum_of_its_own() {
    let mut draw = Draw::new(25);
    for _ in 0..200 {
        let lines = random_lines(&mut draw, 3000, 300);
        let accesses = line_accesses(
            &[Region { name: "a".into(), base: 0, size: 4096, record_size: 4, coding: Coding::Records }],
            4,
            &lines.iter().map(|line| Event::Access(Access::read(0, line * 4, 4))).collect::<Vec<_>>(),
        );
        for (cache, index) in
            [("512,8,4,min", SetIndex::Plain), ("512,8,4,min,hash", SetIndex::Hash), ("800,50,4,min", SetIndex::Plain)]
        {
            let config: CacheConfig = cache.parse().unwrap();
            let ways = (config.lines() / config.sets()) as usize;
            let sets = by_set(&accesses, config.sets(), index);
            let expected: u64 = sets.iter().map(|lines| mattson(lines, ways)[ways - 1]).sum();
            assert_eq!(fetches(&lines, &[config]), [expected], "{cache}");
        }
    }
}

#[test]
fn a_trace_of_more_misses_than_the_window_has_times_is_counted_to_the_end() {
    // A loop over n lines, one more than fit: after the first round the optimum misses once in n - 1 accesses, once in n
    // if what it does not keep may pass by.
    let lines: Vec<u64> = (0..300 * 1000).map(|i| i % 1000).collect();
    let caches = ["3996,full,4,min", "3996,full,4,min-bypass"].map(|cache| cache.parse().unwrap());
    assert_eq!(fetches(&lines, &caches), [1000 + 299_000 / 999, 1000 + 299_000 / 1000]);
    // And at random: 100,000 accesses, most of which miss.
    let mut draw = Draw::new(26);
    let mut lines: Vec<u64> = (0..100_000).map(|_| draw.below(1000)).collect();
    lines.dedup();
    let sizes = [3, 100];
    let caches: Vec<CacheConfig> =
        sizes.iter().map(|n| format!("{},full,4,min-bypass", n * 4).parse().unwrap()).collect();
    let expected: Vec<u64> = sizes.iter().map(|&n| occupancy(&lines, n)).collect();
    assert_eq!(fetches(&lines, &caches), expected);
}
