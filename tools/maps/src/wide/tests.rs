//! The wide tree against brute force, by every kind of instructions.

use super::*;
use crate::trial::{cases, photons, query_points};
use crate::{Blind, BruteForce, Carry, Search, SearchReads};
use pm_random::Random;

/// The same tree for each kind of instructions that this machine has.
fn trees(photons: &[Photon]) -> Vec<WideTree> {
    let there = Instructions::ALL.into_iter().filter(|instructions| instructions.are_there());
    there.map(|instructions| WideTree::build(photons).unwrap().with(instructions)).collect()
}

fn walls(n: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Random::new(&[seed]);
    let mut wall = || {
        let (u, v) = (random.unit(), random.unit());
        [[u, v, 0.0], [u, 0.0, v], [0.0, u, v], [u, v, 1.0]][(random.unit() * 4.0) as usize]
    };
    (0..n).map(|_| wall()).collect()
}

#[test]
fn every_kind_of_instructions_finds_what_brute_force_finds() {
    for n in [1, 15, 16, 17, 255, 256, 257, 5000] {
        let positions = walls(n, n as u64);
        let photons = photons(positions.iter().copied());
        let oracle = BruteForce::build(&photons).unwrap();
        for tree in trees(&photons) {
            let instructions = tree.instructions;
            for k in [1, 10, 100, n, n + 1] {
                let (mut found, mut expected) = (Nearest::new(k, 0.0), Nearest::new(k, 0.0));
                for point in walls(40, 7) {
                    for radius in [0.0, 0.05, 0.3, f32::INFINITY] {
                        Search::new(k, radius).run(&oracle, point, &mut expected, &mut Blind);
                        Search::new(k, radius).run(&tree, point, &mut found, &mut Blind);
                        assert_eq!(found.sorted(), expected.sorted(), "{instructions:?}, {n}, {k}, {radius}");
                        assert_eq!(found.farthest(), expected.farthest());
                    }
                }
            }
        }
    }
}

#[test]
fn a_crowd_fills_the_room_and_is_told_apart() {
    // Ten thousand at one place and as many about it: the room is filled again and again, and ties go by id.
    let mut positions = vec![[0.5; 3]; 10_000];
    positions.extend(walls(10_000, 3).into_iter().map(|p| p.map(|x| 0.5 + x * 1e-3)));
    let photons = photons(positions);
    let oracle = BruteForce::build(&photons).unwrap();
    for tree in trees(&photons) {
        let instructions = tree.instructions;
        for k in [1, 500, 9_999, 10_001] {
            let (mut found, mut expected) = (Nearest::new(k, 0.0), Nearest::new(k, 0.0));
            for radius in [1.0, f32::INFINITY] {
                Search::new(k, radius).run(&oracle, [0.5, 0.5, 0.4999], &mut expected, &mut Blind);
                Search::new(k, radius).run(&tree, [0.5, 0.5, 0.4999], &mut found, &mut Blind);
                assert_eq!(found.sorted(), expected.sorted(), "{instructions:?}, {k}, {radius}");
            }
        }
    }
}

#[test]
fn every_kind_of_instructions_reads_and_finds_the_same_where_maps_break() {
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        let oracle = BruteForce::build(&photons).unwrap();
        let mut all_reads = vec![];
        for tree in trees(&photons) {
            let mut reads = SearchReads::default();
            for k in [1, 20, photons.len().max(1), photons.len() + 1] {
                let (mut found, mut expected) = (Nearest::new(k, 0.0), Nearest::new(k, 0.0));
                for radius in [0.0, 0.05, f32::INFINITY] {
                    let search = Search { start: 0.01, ..Search::new(k, radius) };
                    let mut carry = Carry::default();
                    let anywhere = [[f32::INFINITY, 0.0, 0.0], [f32::NAN; 3], [3e38, -3e38, 1e30]];
                    for point in query_points(&positions).into_iter().chain(anywhere) {
                        Search::new(k, radius).run(&oracle, point, &mut expected, &mut Blind);
                        carry.run(&search, &tree, point, &mut found, &mut reads);
                        let told = || format!("{name}, {:?}, k {k}, {radius}, {point:?}", tree.instructions);
                        assert_eq!(found.sorted(), expected.sorted(), "{}", told());
                        assert_eq!(found.farthest(), expected.farthest(), "{}", told());
                    }
                }
            }
            all_reads.push(reads.runs().map(|(region, records)| (region, records.to_vec())).collect::<Vec<_>>());
        }
        assert!(all_reads.iter().all(|reads| *reads == all_reads[0]), "{name}");
    }
}

#[test]
fn one_photon_is_found_without_reading_all_that_is_nearer_than_the_last_query() {
    // At a photon the nearest one is no distance away, which tells nothing of a radius for other places.
    let photons = photons(walls(20_000, 11));
    for tree in trees(&photons) {
        let search = Search::new(1, f32::INFINITY).fit_start(&tree, &photons);
        let (mut found, mut carry, mut reads) = (Nearest::new(1, 0.0), Carry::default(), SearchReads::default());
        walls(200, 12).into_iter().for_each(|point| _ = carry.run(&search, &tree, point, &mut found, &mut reads));
        assert!(reads.len() < 200 * 16, "{} reads", reads.len());
    }
}

#[test]
fn what_is_carried_is_exact_along_a_path_over_equal_distances() {
    // On a lattice many photons are as far as the k-th, and bounds from above and below lie close about them.
    let photons = photons((0..32_768u32).map(|i| [i % 32, i / 32 % 32, i / 1024].map(|x| x as f32 / 16.0)));
    let oracle = BruteForce::build(&photons).unwrap();
    for tree in trees(&photons) {
        for k in [1, 7, 100, 500] {
            let search = Search::new(k, f32::INFINITY).fit_start(&tree, &photons);
            let (mut found, mut expected) = (Nearest::new(k, 0.0), Nearest::new(k, 0.0));
            let mut carry = Carry::default();
            for step in 0..40u16 {
                // Small steps, no step, and a jump.
                let x = f32::from(step / 2) / 64.0 + if step > 30 { 1.0 } else { 0.0 };
                let point = [x, 0.5, 0.75];
                carry.run(&search, &tree, point, &mut found, &mut Blind);
                search.run(&oracle, point, &mut expected, &mut Blind);
                assert_eq!(found.sorted(), expected.sorted(), "{:?}, k {k}, step {step}", tree.instructions);
            }
        }
    }
}
