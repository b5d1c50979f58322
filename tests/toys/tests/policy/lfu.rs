//! Least frequently used: a policy that counts uses, and so has to see every one of them.

use pm_caches::trial::{Definition, FullSet};
use pm_caches::{CacheModel, CacheOnTrace, Policy, Replacement};

pm_registry::registered! {
    /// The line used least often since it came, of several the one used least recently
    pub(crate) struct Lfu = "rarest";
}

impl Policy for Lfu {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Uses::new(cache.sets(), cache.ways()))
    }

    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(|full: &FullSet| full.least(|held| (held.uses().len(), held.last_use())))
    }
}

/// How often each line was used since it came, and when last.
pub(crate) struct Uses {
    uses: Vec<(u64, u64)>,
    now: u64,
    ways: usize,
}

impl Uses {
    pub(crate) fn new(sets: usize, ways: usize) -> Self {
        Self { uses: vec![(0, 0); sets * ways], now: 0, ways }
    }
}

impl Replacement for Uses {
    fn hit(&mut self, set: usize, way: usize) {
        let (number, last) = &mut self.uses[set * self.ways + way];
        self.now += 1;
        *number += 1;
        *last = self.now;
    }

    fn fill(&mut self, set: usize, way: usize) {
        self.uses[set * self.ways + way].0 = 0;
        self.hit(set, way);
    }

    fn victim(&mut self, set: usize) -> usize {
        let ways = &self.uses[set * self.ways..][..self.ways];
        (0..self.ways).min_by_key(|&way| ways[way]).expect("at least one way")
    }
}
