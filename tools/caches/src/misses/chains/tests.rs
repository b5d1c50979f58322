//! Are chains as long as in a graph of which read waits for which?

use pm_formats::trace::{Access, Coding, Region, TraceSink, Waits, lay_out};

use crate::trial::Draw;
use crate::{CacheConfig, Distribution, Measures, Simulation, Ways};

/// A read of a search: what it waits for, and where it is.
type Read = (Waits, u64, u32);

fn regions() -> Vec<Region> {
    lay_out([("records".to_owned(), 4096, 16, Coding::Waiting)])
}

fn chains(configs: &[CacheConfig], searches: &[(bool, Vec<Read>)], chunk: usize) -> Vec<Distribution> {
    let measures = Measures { miss_chains: true, split: true, ..Measures::default() };
    let mut simulation = Simulation::in_chunks(&regions(), configs, &measures, chunk).unwrap();
    for (warm_up, reads) in searches {
        simulation.block(0, *warm_up);
        simulation.search(&[0]);
        for &(waits, offset, len) in reads {
            simulation.waits(waits);
            simulation.access(Access::read(0, offset, len));
        }
        simulation.search_end();
    }
    simulation.finish().into_iter().map(|counts| counts.more.miss_chains.unwrap()).collect()
}

/// Which of the reads before it a read waits for, by the words of the format.
fn waited_for(reads: &[Read], at: usize) -> Vec<usize> {
    let attempt = (0..=at).rev().find(|&i| reads[i].0 == Waits::ALL_BEFORE);
    let first = attempt.unwrap_or(0);
    let (waits, above) = (reads[at].0, |i: &usize| reads[*i].0.level() + 1 == reads[at].0.level());
    match (waits.level(), waits.is_for_all()) {
        (0, _) => (0..first).collect(),
        (_, true) => (first..at).filter(above).collect(),
        (_, false) => (first..at).rev().find(above).into_iter().collect(),
    }
}

/// The longest chain of misses of a search.
fn longest(reads: &[Read], missed: &[bool]) -> u32 {
    let mut chains: Vec<u32> = vec![];
    for (at, &missed) in missed.iter().enumerate() {
        let before = waited_for(reads, at).into_iter().map(|i| chains[i]).max().unwrap_or(0);
        chains.push(before + u32::from(missed));
    }
    chains.into_iter().max().unwrap_or(0)
}

/// Whether each read misses in a list of so many lines by recency.
fn missed(list: &mut Vec<u64>, lines: usize, line: u64, reads: &[Read]) -> Vec<bool> {
    let base = regions()[0].base;
    let miss = |&(_, offset, len): &Read| {
        let touched = (base + offset) / line..=(base + offset + u64::from(len.max(1)) - 1) / line;
        touched.fold(false, |missed, line| {
            let at = list.iter().position(|&held| held == line);
            at.map(|at| list.remove(at));
            list.insert(0, line);
            list.truncate(lines);
            missed | at.is_none()
        })
    };
    reads.iter().map(miss).collect()
}

#[test]
fn chains_are_the_longest_paths_of_a_graph() {
    let mut draw = Draw::new(51);
    let mut most = 0;
    for case in 0..400 {
        let leap = draw.pick(&[100, 600, 4000]);
        let searches: Vec<(bool, Vec<Read>)> = (0..draw.below(9))
            .map(|_| {
                let mut levels = 0;
                let reads = (0..draw.below(14)).map(|_| {
                    let level = draw.below(levels.min(5) + 1) as u16;
                    let for_all = draw.below(if level == 0 { 4 } else { 2 }) == 0;
                    levels = if level == 0 && for_all { 1 } else { levels.max(u64::from(level) + 1) };
                    let waits = if for_all { Waits::all_above(level) } else { Waits::last_above(level) };
                    (waits, draw.below(leap), draw.pick(&[1, 16, 16, 90]))
                });
                let reads = reads.collect();
                (draw.below(4) == 0, reads)
            })
            .collect();
        let line = draw.pick(&[16_u32, 64]);
        let sizes = [2_u64, 5, 40];
        let mut configs =
            sizes.map(|lines| CacheConfig::lru(lines * u64::from(line), Ways::Full, line).unwrap()).to_vec();
        configs.push(CacheConfig::none(line).unwrap());
        let found = chains(&configs, &searches, draw.pick(&[1, 3, 2048]));
        for (cache, lines) in sizes.into_iter().chain([0]).enumerate() {
            let (mut list, mut expected) = (vec![], Distribution::default());
            for (warm_up, reads) in &searches {
                let missed = match lines {
                    0 => vec![true; reads.len()],
                    _ => missed(&mut list, lines as usize, line.into(), reads),
                };
                let chain = longest(reads, &missed);
                most = most.max(chain);
                if !warm_up {
                    expected.add(chain);
                }
            }
            assert_eq!(found[cache], expected, "case {case}, {}: left: model, right: graph", configs[cache]);
        }
    }
    assert!(most > 8, "chains of {most} at most are no test");
}

#[test]
fn blocks_wait_for_all_buckets_and_children_for_their_parents() {
    let cache = [CacheConfig::lru(4096, Ways::Full, 16).unwrap()];
    let one = |chains: &Distribution| (chains.number(), chains.sum(), chains.max());
    // Three buckets, and blocks that the first of them leads to; then the same again, of which nothing is fetched.
    let bucket = |i: u64| (Waits::NOTHING, 16 * i, 16);
    let block = |i: u64| (Waits::all_above(1), 16 * i, 16);
    let search = vec![bucket(0), bucket(1), bucket(2), block(100), block(101)];
    let twice = [(false, search.clone()), (false, search)];
    assert_eq!(one(&chains(&cache, &twice, 2048)[0]), (2, 2, Some(2)));
    // The last bucket is there already, and a block waits all the same for those that are not.
    let warm = [(true, vec![bucket(2)]), (false, vec![bucket(0), bucket(2), block(100)])];
    assert_eq!(one(&chains(&cache, &warm, 2048)[0]), (1, 2, Some(2)));

    // A tree of which all but the root is in the cache: the leaves on both sides wait for it, and not for one another.
    let node = |level: u16, i: u64| (Waits::last_above(level), 16 * i, 16);
    let [left, right] = [node(1, 1), node(1, 2)];
    let tree = vec![node(0, 0), left, node(2, 3), node(2, 4), right, node(2, 5)];
    assert_eq!(one(&chains(&cache, &[(true, vec![left, right]), (false, tree)], 2048)[0]), (1, 2, Some(2)));
    // Another attempt waits for the one before, and what follows it too.
    let again = vec![node(0, 0), left, (Waits::ALL_BEFORE, 16 * 9, 16), node(0, 10), node(1, 11)];
    assert_eq!(one(&chains(&cache, &[(false, again)], 2048)[0]), (1, 4, Some(4)));
    // A record of two lines is fetched at once.
    assert_eq!(one(&chains(&cache, &[(false, vec![(Waits::NOTHING, 8, 16)])], 2048)[0]), (1, 1, Some(1)));
}
