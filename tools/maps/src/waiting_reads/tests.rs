//! Is what reads wait for remembered as maps tell it?

use super::*;
use crate::{Nearest, Search, trial};

/// Of all reads of one search for every photon on a line: region, record, level, and whether it waits for all above.
fn waits(line: &str, photons: u16) -> Vec<(u16, u32, u16, bool)> {
    let photons = trial::photons((0..photons).map(|x| [f32::from(x), 0.0, 0.0]));
    let map = crate::tests::build(line, &photons, photons.len());
    let (mut reads, mut waits) = (SearchReads::default(), vec![]);
    let mut eyes = WaitingReads::new(&mut reads, &mut waits);
    map.nearest_seen([0.1, 0.0, 0.0], &mut Nearest::new(photons.len(), f32::INFINITY), &mut eyes);
    let mut records: Vec<_> =
        reads.runs().flat_map(|(region, records)| records.iter().map(move |&record| (region, record))).collect();
    assert_eq!(waits.len(), records.len());
    let waits = waits.iter().map(|waits| (waits.level(), waits.is_for_all()));
    let mut all: Vec<_> = records.drain(..).zip(waits).map(|((a, b), (c, d))| (a, b, c, d)).collect();
    all.sort_unstable();
    all
}

/// Records of a region that wait alike.
fn alike(region: u16, records: std::ops::Range<u32>, level: u16, for_all: bool) -> Vec<(u16, u32, u16, bool)> {
    records.map(|record| (region, record, level, for_all)).collect()
}

#[test]
fn levels_of_small_maps_are_those_worked_out_by_hand() {
    // Node i is record i - 1, and has 2i and 2i + 1 below it.
    let heap = |leaves| [alike(0, 0..1, 0, false), alike(0, 1..3, 1, false), leaves].concat();
    assert_eq!(waits("kd", 7), heap(alike(0, 3..7, 2, false)));
    // Six photons a leaf.
    assert_eq!(waits("bucket-kd", 24), heap(alike(1, 0..4, 2, false)));
    // A root, two leaves, and their photons, which wait for the leaves and not for one another.
    let vvh = [alike(0, 0..1, 0, false), alike(0, 1..3, 1, false), alike(1, 0..7, 2, false)].concat();
    assert_eq!(waits("vvh", 7), vvh);
    // Two blocks below one page.
    assert_eq!(waits("kdb", 12), [alike(0, 0..1, 0, false), alike(1, 0..2, 1, false)].concat());
    // All records of the one cell; all photons at once.
    assert_eq!(waits("brute", 5), alike(0, 0..5, 0, false));
    // Buckets wait for nothing, and blocks for all buckets.
    let hashed = waits("block-hash", 7);
    assert!(hashed.iter().all(|&(region, _, level, for_all)| (level, for_all) == (region, region == 1)), "{hashed:?}");
    assert!(hashed.iter().any(|read| read.0 == 1), "{hashed:?}");
    let grid = waits("grid", 7);
    assert!(grid.iter().all(|&(region, _, level, for_all)| level == region && !for_all), "{grid:?}");
}

#[test]
fn another_attempt_waits_for_the_one_before() {
    let photons = trial::photons((0..7u8).map(|x| [f32::from(x), 0.0, 0.0]));
    let (map, mut reads, mut waits) = (crate::tests::build("kd", &photons, 7), SearchReads::default(), vec![]);
    let search = Search { start: 2.0, ..Search::new(7, f32::INFINITY) };
    let attempts =
        search.run(&*map, [0.0; 3], &mut Nearest::new(7, 0.0), &mut WaitingReads::new(&mut reads, &mut waits));
    let roots: Vec<_> = waits.iter().filter(|waits| waits.level() == 0).collect();
    assert_eq!((attempts, roots), (3, vec![&Waits::NOTHING, &Waits::ALL_BEFORE, &Waits::ALL_BEFORE]));
}
