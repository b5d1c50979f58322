//! Evicts the line of the set that came first.

use super::Policy;
use crate::models::{CacheModel, CacheOnTrace, Replacement};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// The line that came first
    pub(crate) struct Fifo = "fifo";
}

impl Policy for Fifo {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Turns::new(cache.sets(), cache.ways()))
    }
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(|full: &FullSet| full.least(|held| held.came()))
    }
}

/// The way whose turn it is, by set. Ways are filled in order, so they are emptied in order, round and round.
struct Turns {
    next: Vec<u32>,
    ways: u32,
}

impl Turns {
    fn new(sets: usize, ways: usize) -> Self {
        Self { next: vec![0; sets], ways: ways as u32 }
    }
}

impl Replacement for Turns {
    const REPEATS_MATTER: bool = false;

    #[inline]
    fn hit(&mut self, _: usize, _: usize) {}

    #[inline]
    fn fill(&mut self, _: usize, _: usize) {}

    #[inline]
    fn victim(&mut self, set: usize) -> usize {
        let victim = self.next[set];
        self.next[set] = if victim + 1 == self.ways { 0 } else { victim + 1 };
        victim as usize
    }
}
