//! Evicts the line that a binary tree of bits over the ways of the set points away from.

use std::collections::BTreeMap;

use super::{Policy, WaysNeeded};
use crate::config::nearest;
use crate::models::{CacheModel, CacheOnTrace, Replacement};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// The line that the bits of a binary tree over the ways point away from: tree pseudo-LRU
    pub(crate) struct TreePlru = "plru";
}

impl Policy for TreePlru {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Tree::new(cache.sets(), cache.ways()))
    }
    fn definition(&self, _: u64, ways: u64, _: u64) -> Box<dyn Definition> {
        Box::new(Halves { ways: ways as usize, used_last: BTreeMap::new() })
    }
    fn allows_ways(&self, ways: u64) -> Result<(), WaysNeeded> {
        if ways.is_power_of_two() {
            return Ok(());
        }
        let below = 1_u64 << ways.max(1).ilog2();
        let nearest = nearest(ways, Some(below), below.checked_mul(2));
        Err(WaysNeeded { what: "a power of two of ways", nearest })
    }
}

/// Tree pseudo-LRU: at each inner node of a complete binary tree over the ways, which half was *not* used last.
///
/// A use makes the nodes above its way point to the other half; the victim is where the nodes point to. With two ways that
/// is LRU.
struct Tree {
    /// Of each node, whether it points to the upper half. Node 1 of a set is the root, node n has children 2n and 2n + 1,
    /// way w hangs below as node ways + w. Set s owns `upper[s * ways..][..ways]`, node 0 of which is no node.
    upper: Vec<bool>,
    /// log2 of the ways.
    levels: u32,
}

impl Tree {
    /// `ways` is a power of two.
    fn new(sets: usize, ways: usize) -> Self {
        assert!(ways.is_power_of_two());
        Self { upper: vec![false; sets * ways], levels: ways.ilog2() }
    }
}

impl Replacement for Tree {
    const REPEATS_MATTER: bool = false;

    #[inline]
    fn hit(&mut self, set: usize, way: usize) {
        let ways = 1_usize << self.levels;
        let nodes = &mut self.upper[set << self.levels..][..ways];
        let mut node = ways + way;
        while node > 1 {
            nodes[node / 2] = node.is_multiple_of(2);
            node /= 2;
        }
    }

    #[inline]
    fn fill(&mut self, set: usize, way: usize) {
        self.hit(set, way);
    }

    #[inline]
    fn victim(&mut self, set: usize) -> usize {
        let ways = 1_usize << self.levels;
        let nodes = &self.upper[set << self.levels..][..ways];
        let node = (0..self.levels).fold(1, |node, _| 2 * node + usize::from(nodes[node]));
        node - ways
    }
}

/// The definition: at each node of the tree, which half was used last.
struct Halves {
    ways: usize,
    /// By set and the ways that the node spans, first and end, whether the upper half was.
    used_last: BTreeMap<(u64, usize, usize), bool>,
}

impl Definition for Halves {
    fn used(&mut self, set: u64, way: usize) {
        let (mut first, mut end) = (0, self.ways);
        while end - first > 1 {
            let middle = (first + end) / 2;
            self.used_last.insert((set, first, end), way >= middle);
            (first, end) = if way < middle { (first, middle) } else { (middle, end) };
        }
    }

    fn victim(&mut self, full: &FullSet) -> Option<usize> {
        // Never into the half used last.
        let (mut first, mut end) = (0, self.ways);
        while end - first > 1 {
            let middle = (first + end) / 2;
            let upper_was = self.used_last[&(full.set(), first, end)];
            (first, end) = if upper_was { (first, middle) } else { (middle, end) };
        }
        Some(first)
    }
}
