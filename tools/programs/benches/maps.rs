//! How fast are the photon maps, as ratios to the plain kd-tree of the textbook?
//!
//! The yardstick is Jensen's search written here once more with no observer in it, over the nodes of the same tree. That
//! the real search with an observer that does nothing takes no longer is what makes one search for pictures and traces
//! possible. Rounds are interleaved and medians compared, so that a busy machine slows all alike; all must find the same.
//!
//! `cargo bench -p pm-programs --bench maps [-- QUERIES [ROUNDS [PHOTONS]]]`.
#![allow(clippy::print_stdout)]

mod common;
mod room;

use common::{cpu_time, median, morton};
use pm_formats::Photon;
use pm_maps::{
    AccessObserver, AnyMap, Blind, BucketKdTree, Carry, Cells, Grid, KdTree, KdbOptions, KdbTree, Layout, Nearest,
    PageForm, PhotonMap, Search, SearchReads, VvhTree, WideTree,
};
use room::Room;
use std::hint::black_box;

const K: usize = 100;

fn main() {
    let Room { queries, rounds, photons, scattered } = Room::asked_for();
    let count = photons.len();
    // As dense as the queries of a whole picture: all of them in a small part of the room.
    let mut sorted: Vec<[f32; 3]> = scattered.iter().map(|p| p.map(|x| 0.45 + 0.1 * x)).map(onto_wall).collect();
    sorted.sort_by_key(morton);
    let maps = Maps::new(&photons);
    for (name, points) in [("scattered", &scattered), ("neighbours in sequence", &sorted)] {
        println!("{name}: {queries} queries, {K} of {count} photons; k-th photon's distance, time to the yardstick's");
        maps.measure(points, rounds);
    }
}

/// A name, and a job that sums the distances it found.
type Contestant<'a> = (&'a str, Box<dyn FnMut() -> f64 + 'a>);

struct Maps {
    stripped: Stripped,
    kd: KdTree,
    bucket: [BucketKdTree; 3],
    vvh: VvhTree,
    kdb: KdbTree,
    grid: Grid,
    wide: WideTree,
    search: Search,
}

impl Maps {
    fn new(photons: &[Photon]) -> Self {
        let kd = KdTree::build(photons, Layout::Heap).unwrap();
        let kdb = KdbOptions { line: 128, pages: PageForm::Compact, fill: 1.0 };
        Self {
            stripped: Stripped::new(&kd, photons),
            bucket: [128, 320, 640].map(|line| BucketKdTree::build(photons, Layout::Heap, line).unwrap()),
            vvh: VvhTree::build(photons, K, 128).unwrap(),
            kdb: KdbTree::build(photons, kdb).unwrap(),
            grid: Grid::build(photons, Cells::Indirect).unwrap(),
            wide: WideTree::build(photons).unwrap(),
            search: Search::new(K, f32::INFINITY).fit_start(&kd, photons),
            kd,
        }
    }

    fn measure(&self, points: &[[f32; 3]], rounds: usize) {
        let search = &self.search;
        let mut reads = SearchReads::default();
        let mut contestants: Vec<Contestant<'_>> = vec![
            ("kd, stripped by hand", Box::new(|| self.stripped.run(points, search))),
            ("kd, blind", Box::new(|| run(&self.kd, search, points, &mut Blind))),
            (
                "kd, reads remembered",
                Box::new(move || {
                    reads.clear();
                    run(&self.kd, search, points, &mut reads)
                }),
            ),
            ("kd, behind its face", Box::new(|| run(&self.kd as &dyn AnyMap, search, points, &mut Blind))),
            ("kd, carried", Box::new(|| run_carried(&self.kd, search, points))),
            ("bucket-kd, line 128", Box::new(|| run(&self.bucket[0], search, points, &mut Blind))),
            ("bucket-kd, line 320", Box::new(|| run(&self.bucket[1], search, points, &mut Blind))),
            ("bucket-kd, line 640", Box::new(|| run(&self.bucket[2], search, points, &mut Blind))),
            ("bucket-kd, line 320, carried", Box::new(|| run_carried(&self.bucket[1], search, points))),
            ("vvh", Box::new(|| run(&self.vvh, search, points, &mut Blind))),
            ("kdb", Box::new(|| run(&self.kdb, search, points, &mut Blind))),
            ("grid", Box::new(|| run(&self.grid, search, points, &mut Blind))),
            ("wide", Box::new(|| run(&self.wide, search, points, &mut Blind))),
            ("wide, carried", Box::new(|| run_carried(&self.wide, search, points))),
        ];
        let mut times = vec![Vec::new(); contestants.len()];
        let mut results = vec![0.0; contestants.len()];
        for _ in 0..rounds {
            for (i, (_, contestant)) in contestants.iter_mut().enumerate() {
                let start = cpu_time();
                results[i] = black_box(contestant());
                times[i].push((cpu_time() - start).as_secs_f64());
            }
        }
        for (i, (name, _)) in contestants.iter().enumerate() {
            assert!(results[i] == results[0], "{name} found {} instead of {}", results[i], results[0]);
            // Ratios within a round: both were slowed by the same neighbours.
            let ratio = median(times[i].iter().zip(&times[0]).map(|(time, yardstick)| time / yardstick).collect());
            let micros = median(times[i].clone()) * 1e6 / points.len() as f64;
            println!("  {name:30} {:.5}  {micros:6.2} us  {ratio:5.2}", results[i] / points.len() as f64);
        }
    }
}

fn sum(points: &[[f32; 3]], mut radius: impl FnMut([f32; 3]) -> f32) -> f64 {
    points.iter().map(|&point| f64::from(radius(point).sqrt())).sum()
}

fn run(map: &(impl PhotonMap + ?Sized), search: &Search, points: &[[f32; 3]], eyes: &mut impl AccessObserver) -> f64 {
    let mut found = Nearest::new(K, 0.0);
    sum(points, |point| {
        search.run(map, point, &mut found, eyes);
        found.bound()
    })
}

fn run_carried(map: &impl PhotonMap, search: &Search, points: &[[f32; 3]]) -> f64 {
    let (mut found, mut carry) = (Nearest::new(K, 0.0), Carry::default());
    sum(points, |point| {
        carry.run(search, map, point, &mut found, &mut Blind);
        found.bound()
    })
}

/// The same tree and the same search, without an observer.
struct Stripped(Vec<StrippedNode>);

#[derive(Clone, Copy)]
#[repr(C, align(16))]
struct StrippedNode {
    position: [f32; 3],
    id_and_axis: u32,
}

impl Stripped {
    fn new(tree: &KdTree, photons: &[Photon]) -> Self {
        let node = |(axis, id): (usize, u32)| StrippedNode {
            position: photons[id as usize].position,
            id_and_axis: id | (axis as u32) << 30,
        };
        Self(tree.nodes().map(node).collect())
    }

    fn run(&self, points: &[[f32; 3]], search: &Search) -> f64 {
        let mut found = Nearest::new(K, 0.0);
        sum(points, |point| {
            let mut radius = search.start;
            loop {
                found.restart(radius * radius);
                self.nearest(point, &mut found);
                if found.is_full() {
                    return found.bound();
                }
                radius *= 2.0;
            }
        })
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest) {
        let nodes = &self.0[..];
        let count = nodes.len();
        if count == 0 {
            return;
        }
        let mut above = [(0u32, 0u32, 0f32); 32];
        let mut depth = 0;
        let mut at = 1;
        loop {
            let node = &nodes[at - 1];
            let left = 2 * at;
            if left <= count {
                let axis = node.axis();
                let delta = point[axis] - node.position[axis];
                let (near, far) = if delta > 0.0 { (left + 1, left) } else { (left, left + 1) };
                if near <= count {
                    above[depth] = (at as u32, if far <= count { far as u32 } else { 0 }, delta * delta);
                    depth += 1;
                    at = near;
                    continue;
                }
                if delta * delta <= found.bound() {
                    above[depth] = (at as u32, 0, 0.0);
                    depth += 1;
                    at = far;
                    continue;
                }
            }
            found.show(distance_squared(point, node.position), node.id());
            loop {
                if depth == 0 {
                    return;
                }
                let (parent, far, plane) = above[depth - 1];
                if far != 0 && plane <= found.bound() {
                    above[depth - 1].1 = 0;
                    at = far as usize;
                    break;
                }
                depth -= 1;
                let node = &nodes[parent as usize - 1];
                found.show(distance_squared(point, node.position), node.id());
            }
        }
    }
}

impl StrippedNode {
    #[inline(always)]
    const fn id(self) -> u32 {
        self.id_and_axis & 0x3fff_ffff
    }

    #[inline(always)]
    const fn axis(self) -> usize {
        (self.id_and_axis >> 30) as usize
    }
}

#[inline(always)]
fn distance_squared(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [dx, dy, dz] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (dx * dx + dy * dy) + dz * dz
}

/// A point of the room's middle, moved onto the floor.
fn onto_wall([x, _, z]: [f32; 3]) -> [f32; 3] {
    [x, 0.0, z]
}
