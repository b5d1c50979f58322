//! Evicts the line used least often since it came in.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::Policy;
use crate::models::{CacheModel, CacheOnTrace, Replacement};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// The line used least often since it came in, of equals the one used least recently
    pub(crate) struct Lfu = "lfu";
}

impl Policy for Lfu {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Uses::new(cache.sets(), cache.ways()))
    }
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(|full: &FullSet| full.least(|held| (held.uses().len(), held.last_use())))
    }
}

/// How often a line was used, and when last.
type Rank = (u64, u64);

/// How often each line was used, and a heap for each set.
///
/// Ranks only ever rise, so an entry of a heap may be of old: whether it is shows when it comes out, and then it goes in again
/// with the rank it has. So a hit costs one store, and each hit at most one such return.
struct Uses {
    ranks: Vec<Rank>,
    heaps: Vec<BinaryHeap<Reverse<(Rank, u32)>>>,
    now: u64,
    ways: usize,
}

impl Uses {
    fn new(sets: usize, ways: usize) -> Self {
        Self { ranks: vec![(0, 0); sets * ways], heaps: vec![BinaryHeap::new(); sets], now: 0, ways }
    }
}

impl Replacement for Uses {
    #[inline]
    fn hit(&mut self, set: usize, way: usize) {
        self.now += 1;
        let (uses, last) = &mut self.ranks[set * self.ways + way];
        (*uses, *last) = (*uses + 1, self.now);
    }

    #[inline]
    fn fill(&mut self, set: usize, way: usize) {
        self.now += 1;
        self.ranks[set * self.ways + way] = (1, self.now);
        self.heaps[set].push(Reverse(((1, self.now), way as u32)));
    }

    #[inline]
    fn victim(&mut self, set: usize) -> usize {
        let (ranks, heap) = (&self.ranks[set * self.ways..][..self.ways], &mut self.heaps[set]);
        loop {
            let Some(Reverse((rank, way))) = heap.pop() else { return 0 };
            let is = ranks[way as usize];
            if rank == is {
                return way as usize;
            }
            heap.push(Reverse((is, way)));
        }
    }
}
