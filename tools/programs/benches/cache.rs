//! How fast are the simulated caches, as ratios to the plainest loop that does the job?
//!
//! The yardstick is a fully associative LRU of one size over block numbers in memory: a table from block to node, and a
//! doubly linked list of nodes. For sets, it is the blocks of each set in order of use, all of them searched. What is
//! measured starts from accesses to byte offsets, as a trace is replayed. Rounds are interleaved and medians of processor
//! time compared, so that a busy machine slows both alike. Both must count the same.
//!
//! The trace is that of k-nearest-neighbour searches in an implicit kd-tree, for queries in no order and in an order that
//! goes through space cell by cell. `cargo bench -p pm-programs --bench cache [-- QUERIES [ROUNDS]]`.
#![allow(clippy::print_stdout)]

mod common;

use common::{cpu_time, median, morton, surface_point};
use pm_caches::{CacheConfig, Measures, Simulation, policies};
use pm_formats::trace::{Access, Coding, Region, TraceSink, lay_out};
use pm_random::Random;
use std::hint::black_box;

const PHOTONS: usize = 400_000;
const K: usize = 100;
/// The paper's cache: 128 KB in lines of 128 bytes.
const LINES: usize = 1024;
/// Six records of 20 bytes in a line and eight bytes of nothing: none crosses into the next.
const PER_LINE: usize = 6;

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let queries = numbers.first().copied().unwrap_or(20_000);
    let rounds = numbers.get(1).copied().unwrap_or(7);
    let tree = Tree::new(PHOTONS);
    for (name, order) in [("scattered", Order::Scattered), ("cell by cell", Order::Cells)] {
        let nodes = tree.trace(queries, order);
        let blocks: Vec<u32> = nodes.iter().map(|n| n / PER_LINE as u32).collect();
        let misses = naive(&blocks, LINES);
        println!(
            "{name}: {} accesses, {misses} misses of {LINES} lines ({:.2} %)",
            blocks.len(),
            100.0 * misses as f64 / blocks.len() as f64
        );
        measure(&nodes, &blocks, rounds);
    }
}

/// A name, and a job that counts misses.
type Contestant<'a> = (&'a str, Box<dyn Fn() -> u64 + 'a>);

fn measure(nodes: &[u32], blocks: &[u32], rounds: usize) {
    let offsets: Vec<u32> = nodes.iter().map(|&node| padded(node)).collect();
    let packed: Vec<u32> = nodes.iter().map(|&node| node * 20).collect();
    let offsets = &offsets;
    let one = ["128K,full,128,lru"];
    let ten: Vec<String> = (0..10).map(|i| format!("{},full,128,lru", 8192_u64 << i)).collect();
    let ten: Vec<&str> = ten.iter().map(String::as_str).collect();
    let one_by_one = |caches: &[&str]| caches.iter().map(|c| simulate(offsets, &[*c])).sum();
    let mut contestants: Vec<Contestant> = vec![
        ("yardstick: table and list", Box::new(|| naive(blocks, LINES))),
        ("the same list fed accesses", Box::new(|| naive_sink(offsets, LINES))),
        ("128K,full,128,lru", Box::new(|| simulate(offsets, &one))),
        ("... packed, 1 in 8 spans lines", Box::new(|| simulate(&packed, &one))),
        ("3 sizes, one stack", Box::new(|| simulate(offsets, &ten[3..6]))),
        ("3 sizes, one by one", Box::new(|| one_by_one(&ten[3..6]))),
        ("10 sizes, one stack", Box::new(|| simulate(offsets, &ten))),
        ("10 sizes, one by one", Box::new(|| one_by_one(&ten))),
        ("3 lines: 64, 128, 256", Box::new(|| simulate(offsets, &["128K,full,64,lru", one[0], "128K,full,256,lru"]))),
        ("no cache", Box::new(|| simulate(offsets, &["none"]))),
        ("curve: every size", Box::new(|| curves(offsets, &[128], None))),
        ("curves of lines 32, 64, 128", Box::new(|| curves(offsets, &[32, 64, 128], None))),
        ("curve from 0.1 of the lines", Box::new(|| curves(offsets, &[128], Some(0.1)))),
        ("curve from 0.01 of the lines", Box::new(|| curves(offsets, &[128], Some(0.01)))),
    ];
    let policies = policies();
    let words = || policies.iter().filter(|policy| policy.keeps_lines()).map(|policy| policy.word());
    // Fully associative LRU stands above.
    for word in words().filter(|word| *word != "lru") {
        let cache = format!("128K,full,128,{word}");
        let name = String::leak(cache.clone());
        contestants.push((name, Box::new(move || simulate(offsets, &[&cache]))));
    }
    compare(blocks.len(), rounds, &contestants, &[(0, 1), (0, 2), (4, 5), (6, 7), (0, 10)]);
    for ways in [8, 16] {
        let name = |text: String| &*String::leak(text);
        let mut contestants: Vec<Contestant> =
            vec![(name(format!("yardstick: {ways} ways in order")), Box::new(move || naive_sets(blocks, LINES, ways)))];
        for word in words().chain(["lru,hash"]) {
            let cache = format!("128K,{ways},128,{word}");
            contestants.push((name(cache.clone()), Box::new(move || simulate(offsets, &[&cache]))));
        }
        compare(blocks.len(), rounds, &contestants, &[(0, 1)]);
    }
}

/// Prints the speed of each contestant, and as a ratio to the first. Those in pairs have to count the same.
fn compare(accesses: usize, rounds: usize, contestants: &[Contestant], pairs: &[(usize, usize)]) {
    let mut times = vec![Vec::new(); contestants.len()];
    let mut results = vec![0; contestants.len()];
    for _ in 0..rounds {
        for (i, (_, run)) in contestants.iter().enumerate() {
            let start = cpu_time();
            results[i] = black_box(run());
            times[i].push((cpu_time() - start).as_secs_f64());
        }
    }
    for &(a, b) in pairs {
        assert_eq!(results[a], results[b], "{} and {} count the same", contestants[a].0, contestants[b].0);
    }
    let yardstick = median(times[0].clone());
    for ((name, _), times) in contestants.iter().zip(times) {
        let time = median(times);
        println!("  {name:32} {:7.1} M accesses/s  {:5.2}", accesses as f64 / time / 1e6, yardstick / time);
    }
}

/// Byte offset of a node whose record does not cross a line.
fn padded(node: u32) -> u32 {
    node / PER_LINE as u32 * 128 + node % PER_LINE as u32 * 20
}

/// Fetches of the yardstick's size, or rather of so many lines, from the curves of these line sizes.
fn curves(offsets: &[u32], lines: &[u32], rate: Option<f64>) -> u64 {
    let measures = Measures { curves: lines.to_vec(), sampled: rate, ..Measures::default() };
    let mut simulation = Simulation::measuring(&regions(), &[], &measures).unwrap();
    simulation.search(&[0]);
    for &offset in offsets {
        simulation.access(Access::read(0, offset.into(), 20));
    }
    let findings = simulation.findings();
    let sampled = findings.sampled.iter().filter_map(|curve| curve.fetches(LINES as u64));
    let exact: u64 = findings.curves.iter().map(|curve| curve.fetches(LINES as u64)).sum();
    exact + sampled.map(|estimate| estimate.fetches as u64).sum::<u64>()
}

/// The photons, padded to lines.
fn regions() -> Vec<Region> {
    let size = PHOTONS.div_ceil(PER_LINE) as u64 * 128;
    lay_out([("photons".to_owned(), size, 20, Coding::Records)])
}

/// Fetches of all caches, for reads of 20 bytes.
fn simulate(offsets: &[u32], caches: &[&str]) -> u64 {
    let configs: Vec<CacheConfig> = caches.iter().map(|c| c.parse().unwrap()).collect();
    let mut simulation = Simulation::new(&regions(), &configs).unwrap();
    simulation.search(&[0]);
    for &offset in offsets {
        simulation.access(Access::read(0, offset.into(), 20));
    }
    simulation.finish().iter().map(|row| row.fetches).sum()
}

/// The yardstick.
fn naive(blocks: &[u32], capacity: usize) -> u64 {
    let mut list = List::new(blocks.iter().max().map_or(0, |&b| b as usize + 1), capacity);
    blocks.iter().for_each(|&block| list.touch(block));
    list.misses
}

/// The yardstick as somebody would put it behind a trace: no regions told apart, no records across lines.
fn naive_sink(offsets: &[u32], capacity: usize) -> u64 {
    struct Sink(List);
    impl TraceSink for Sink {
        #[inline]
        fn access(&mut self, access: Access) {
            self.0.touch((access.offset / 128) as u32);
        }
    }
    let mut sink = Sink(List::new(offsets.iter().max().map_or(0, |&o| o as usize / 128 + 1), capacity));
    offsets.iter().for_each(|&offset| sink.access(Access::read(0, offset.into(), 20)));
    sink.0.misses
}

/// The yardstick for sets: a few blocks in order of use, the last used first.
fn naive_sets(blocks: &[u32], capacity: usize, ways: usize) -> u64 {
    let sets = capacity / ways;
    let mut held = vec![NONE; capacity];
    let mut misses = 0;
    for &block in blocks {
        let set = &mut held[block as usize % sets * ways..][..ways];
        let way = set.iter().position(|&b| b == block).unwrap_or_else(|| {
            misses += 1;
            ways - 1
        });
        set.copy_within(..way, 1);
        set[0] = block;
    }
    misses
}

/// A table from block to node, and a doubly linked list of nodes.
struct List {
    table: Vec<u32>,
    nodes: Vec<Node>,
    capacity: usize,
    newest: u32,
    oldest: u32,
    misses: u64,
}

#[derive(Clone, Copy)]
struct Node {
    block: u32,
    newer: u32,
    older: u32,
}

const NONE: u32 = u32::MAX;

impl List {
    fn new(blocks: usize, capacity: usize) -> Self {
        let (table, nodes) = (vec![NONE; blocks], Vec::with_capacity(capacity));
        Self { table, nodes, capacity, newest: NONE, oldest: NONE, misses: 0 }
    }

    #[inline(always)]
    fn touch(&mut self, block: u32) {
        let mut node = self.table[block as usize];
        if node == self.newest && node != NONE {
            return;
        }
        if node != NONE {
            let Node { newer, older, .. } = self.nodes[node as usize];
            self.nodes[newer as usize].older = older;
            if older == NONE {
                self.oldest = newer;
            } else {
                self.nodes[older as usize].newer = newer;
            }
        } else {
            self.misses += 1;
            if self.nodes.len() < self.capacity {
                node = self.nodes.len() as u32;
                self.nodes.push(Node { block, newer: NONE, older: NONE });
            } else {
                node = self.oldest;
                let old = self.nodes[node as usize];
                self.table[old.block as usize] = NONE;
                self.oldest = old.newer;
                match self.oldest {
                    NONE => self.newest = NONE,
                    o => self.nodes[o as usize].older = NONE,
                }
                self.nodes[node as usize].block = block;
            }
            self.table[block as usize] = node;
        }
        self.nodes[node as usize].newer = NONE;
        self.nodes[node as usize].older = self.newest;
        match self.newest {
            NONE => self.oldest = node,
            n => self.nodes[n as usize].newer = node,
        }
        self.newest = node;
    }
}

enum Order {
    Scattered,
    Cells,
}

/// A balanced kd-tree in heap order: node i has children 2i and 2i + 1, the root is 1.
struct Tree {
    /// Points by node; the place before the root is unused.
    points: Vec<[f32; 3]>,
    axes: Vec<u8>,
}

impl Tree {
    /// Points on the walls and on a ball of a unit room, as photons lie.
    fn new(n: usize) -> Self {
        let mut random = Random::new(&[7]);
        let mut points: Vec<[f32; 3]> = (0..n).map(|_| surface_point(&mut random)).collect();
        let mut tree = Self { points: vec![[0.0; 3]; n + 1], axes: vec![0; n + 1] };
        tree.build(1, &mut points);
        tree
    }

    fn build(&mut self, node: usize, points: &mut [[f32; 3]]) {
        if points.is_empty() {
            return;
        }
        let extent = |axis: usize| {
            let (min, max) = points.iter().fold((f32::MAX, f32::MIN), |(a, b), p| (a.min(p[axis]), b.max(p[axis])));
            max - min
        };
        let axis = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
        let left = left_size(points.len());
        points.select_nth_unstable_by(left, |a, b| a[axis].total_cmp(&b[axis]));
        (self.points[node], self.axes[node]) = (points[left], axis as u8);
        let (low, high) = points.split_at_mut(left);
        self.build(2 * node, low);
        self.build(2 * node + 1, &mut high[1..]);
    }

    /// The nodes that searches visit (from 0), in the order they do.
    fn trace(&self, queries: usize, order: Order) -> Vec<u32> {
        let mut random = Random::new(&[11]);
        let mut points: Vec<[f32; 3]> = (0..queries).map(|_| surface_point(&mut random)).collect();
        if matches!(order, Order::Cells) {
            points.sort_by_key(morton);
        }
        let mut trace = Vec::new();
        for p in points {
            let mut nearest = Vec::with_capacity(K + 1);
            self.search(1, p, &mut nearest, &mut trace);
        }
        trace
    }

    /// Jensen's search; `nearest` is sorted by distance.
    fn search(&self, node: usize, p: [f32; 3], nearest: &mut Vec<f32>, trace: &mut Vec<u32>) {
        if node >= self.points.len() {
            return;
        }
        trace.push(node as u32 - 1);
        let q = self.points[node];
        let axis = self.axes[node] as usize;
        let plane = p[axis] - q[axis];
        let near = 2 * node + usize::from(plane >= 0.0);
        self.search(near, p, nearest, trace);
        let radius = |nearest: &Vec<f32>| if nearest.len() < K { f32::INFINITY } else { nearest[K - 1] };
        let d: f32 = (0..3).map(|i| (p[i] - q[i]) * (p[i] - q[i])).sum();
        if d < radius(nearest) {
            nearest.insert(nearest.partition_point(|&x| x < d), d);
            nearest.truncate(K);
        }
        if plane * plane < radius(nearest) {
            self.search(near ^ 1, p, nearest, trace);
        }
    }
}

/// Nodes left of the root in a complete tree of `n`.
fn left_size(n: usize) -> usize {
    let full = 1 << n.ilog2();
    let (half, last_row) = (full / 2, n + 1 - full);
    half.max(1) - 1 + last_row.min(half)
}
