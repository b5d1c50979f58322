//! Do queries that share a search find what looking at all photons finds for each, and are groups cut where they say?

use super::*;
use crate::trial::{cases, photons, query_points, random_points};
use crate::{BruteForce, Instructions, WideTree};
use pm_formats::Photon;

/// The same tree for each kind of instructions that this machine has.
fn trees(photons: &[Photon]) -> Vec<WideTree> {
    let there = Instructions::ALL.into_iter().filter(|instructions| instructions.are_there());
    there.map(|instructions| WideTree::build(photons).unwrap().with(instructions)).collect()
}

/// Squared distances and ids of a query's neighbours.
type Found = Vec<(f32, u32)>;

/// What was found for the queries of a stretch, what was read for it, and the sizes of its groups.
fn run(map: &dyn AnyMap, search: &Search, points: &[[f32; 3]], most: usize) -> (Vec<Found>, SearchReads, Vec<usize>) {
    let (mut groups, mut held) = (Groups::default(), Nearest::new(search.k, 0.0));
    let (mut all, mut reads, mut sizes, mut at) = (vec![], SearchReads::default(), vec![], 0);
    while at < points.len() {
        sizes.push(groups.begin((most, &points[at..]), search, map, &mut held, Some(&mut reads)));
        for &point in &points[at..at + sizes[sizes.len() - 1]] {
            groups.next(point, search, map, &mut held, Some(&mut reads));
            all.push(held.sorted());
            let farthest = all[all.len() - 1].last().copied();
            assert_eq!(held.farthest(), farthest);
        }
        at += sizes[sizes.len() - 1];
    }
    (all, reads, sizes)
}

/// What looking at all photons finds.
fn expected(photons: &[Photon], search: &Search, points: &[[f32; 3]]) -> Vec<Found> {
    let (oracle, mut held) = (BruteForce::build(photons).unwrap(), Nearest::new(search.k, 0.0));
    let plain = Search::new(search.k, search.max_dist);
    let find = |&point| {
        plain.run(&oracle, point, &mut held, &mut Blind);
        held.sorted()
    };
    points.iter().map(find).collect()
}

/// Panics unless all instructions find the same as brute force, and read the same. The sizes of the groups.
fn check(what: &str, photons: &[Photon], search: &Search, points: &[[f32; 3]]) -> Vec<usize> {
    let expected = expected(photons, search, points);
    let runs = trees(photons).into_iter().map(|tree| {
        let (found, reads, sizes) = run(&tree, search, points, 32);
        for ((found, expected), point) in found.iter().zip(&expected).zip(points) {
            assert_eq!(found, expected, "{what}, {search:?}, {point:?}");
        }
        (reads.runs().map(|(region, records)| (region, records.to_vec())).collect::<Vec<_>>(), sizes)
    });
    let runs: Vec<_> = runs.collect();
    assert!(runs.iter().all(|run| *run == runs[0]), "{what}: other reads by other instructions");
    runs[0].1.clone()
}

/// Steps from a point, of a share of some length, each three times as long as the one before: groups of all sizes.
fn trail(from: [f32; 3], length: f32) -> Vec<[f32; 3]> {
    let step = |at: usize| {
        let far = length * [0.0, 1e-4, 1e-3, 1e-2, 0.03, 0.3, 2.0][at % 7] * (at / 7 % 9) as f32;
        [from[0] + far, from[1] - far * 0.5, from[2] + far * 0.1]
    };
    (0..63).map(step).collect()
}

#[test]
fn a_group_finds_what_looking_at_all_photons_finds_where_maps_break() {
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        let mut points: Vec<[f32; 3]> = query_points(&positions).into_iter().flat_map(|point| [point; 3]).collect();
        let size = positions.iter().flatten().fold(1e-30_f32, |size, x| size.max(x.abs()));
        for &from in positions.iter().step_by((positions.len() / 2).max(1)) {
            for length in [size, size * 0.01, size * 1e-5] {
                points.extend(trail(from, length));
            }
        }
        points.extend([[f32::INFINITY, 0.0, 0.0], [f32::NAN; 3], [f32::NAN; 3], [3e38, -3e38, 1e30], [3e38; 3]]);
        for k in [1, 20, photons.len() + 1] {
            for max_dist in [0.0, 0.05, f32::INFINITY] {
                // A start that may be too small, and one that is not.
                let start = if k == 20 { max_dist.min(0.01) } else { max_dist };
                check(name, &photons, &Search { start, ..Search::new(k, max_dist) }, &points);
            }
        }
    }
}

#[test]
fn groups_on_walls_find_what_looking_at_all_photons_finds() {
    let photons = photons(random_points(20_000, |[x, y, z]| if z < 0.5 { [x, 0.0, y] } else { [0.0, x, y] }));
    let mut points = random_points(2000, |[x, y, z]| [x * 0.03, if z < 0.5 { 0.0 } else { 1e-4 }, 0.3 + y * 0.03]);
    points.sort_by(|a, b| ((a[0] * 300.0).floor(), a[2]).partial_cmp(&((b[0] * 300.0).floor(), b[2])).unwrap());
    for (k, max_dist) in [(1, 1.0), (10, f32::INFINITY), (100, f32::INFINITY), (100, 0.065), (500, f32::INFINITY)] {
        let search = Search::new(k, max_dist).fit_start(&WideTree::build(&photons).unwrap(), &photons);
        let sizes = check("walls", &photons, &search, &points);
        // There are large groups where k is large.
        let largest = sizes.into_iter().max();
        assert!(k < 100 || largest > Some(8), "{k}, {max_dist}: {largest:?}");
    }
}

#[test]
fn ties_of_a_lattice_go_by_id() {
    let photons = photons((0..32_768u32).map(|i| [i % 32, i / 32 % 32, i / 1024].map(|x| x as f32 / 16.0)));
    let points: Vec<[f32; 3]> = (0..120u16).map(|i| [0.5 + f32::from(i / 8) / 64.0, 0.5, 0.75]).collect();
    for k in [1, 7, 100, 500] {
        let sizes = check("lattice", &photons, &Search::new(k, f32::INFINITY), &points);
        assert!(sizes.iter().any(|&size| size >= 8), "{k}: {sizes:?}");
    }
}

#[test]
fn a_crowd_that_has_no_room_is_answered_one_by_one() {
    // Ten thousand at one place, which is the nearest of all: none of them can be told from the others before it is read.
    let mut positions = vec![[0.5; 3]; 10_000];
    positions.extend(random_points(2000, |[x, y, z]| [x, y, z * 0.5]));
    let photons = photons(positions);
    let points: Vec<[f32; 3]> = (0..20u8).map(|i| [0.5 + f32::from(i) * 1e-6, 0.5, 0.52]).collect();
    for k in [1, 100, 11_000] {
        let sizes = check("crowd", &photons, &Search::new(k, f32::INFINITY), &points);
        assert!(k > 1000 || sizes == vec![1; 20], "{k}: {sizes:?}");
    }
}

#[test]
fn a_group_is_as_long_and_as_wide_as_it_may_be() {
    // Points in a row, 0.01 apart: ten steps are 0.1, half the diagonal of their box 0.05.
    let row: Vec<[f32; 3]> = (0..100u8).map(|i| [f32::from(i) * 0.01, 0.0, 0.0]).collect();
    let (count, [x, y, z]) = first_group(&row, 32, 0.0505);
    assert!(count == 11 && (x - 0.05).abs() < 1e-6 && (y, z) == (0.0, 0.0), "{count} {x}");
    assert_eq!(first_group(&row, 4, 0.0505).0, 4);
    assert_eq!(first_group(&row, 32, 1.0).0, 32);
    assert_eq!(first_group(&row, 32, 0.0).0, 1);
    assert_eq!(first_group(&[[0.25; 3]; 5], 32, 0.0), (5, [0.25; 3]));
    assert_eq!(first_group(&[], 32, 1.0).0, 0);
    assert_eq!(first_group(&[[0.0; 3], [f32::NAN; 3], [0.0; 3]], 32, 1.0).0, 1);
}

#[test]
fn neighbours_share_reads_and_strangers_do_not() {
    let photons = photons(random_points(20_000, |[x, y, _]| [x, 0.0, y]));
    let tree = WideTree::build(&photons).unwrap();
    let search = Search::new(100, f32::INFINITY).fit_start(&tree, &photons);
    let near: Vec<[f32; 3]> = (0..320u16).map(|i| [0.3 + f32::from(i) * 1e-5, 0.0, 0.5]).collect();
    let reads = |points: &[[f32; 3]], most| run(&tree, &search, points, most).1.len();
    // One query alone, and then ten groups.
    assert!(reads(&near, 32) * 20 < reads(&near, 1), "{} {}", reads(&near, 32), reads(&near, 1));
    assert!(reads(&near, 8) * 5 < reads(&near, 1));
    let far = random_points(300, |[x, y, _]| [x, 0.0, y]);
    assert_eq!(reads(&far, 32), reads(&far, 1));
}
