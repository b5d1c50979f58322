//! Evicts any line of the set.

use super::Policy;
use crate::models::{CacheModel, CacheOnTrace, Replacement};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// Any line, by a sequence of random numbers; random:SEED for another sequence
    pub(crate) struct Random = "random";
}

impl Policy for Random {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Draws::new(cache.config().policy().seed(), cache.ways()))
    }
    fn definition(&self, _: u64, _: u64, seed: u64) -> Box<dyn Definition> {
        let mut numbers = pm_random::Random::new(&[seed]);
        // Which of as many equal parts of 2^64 the number is in.
        let mut part = move |parts: usize| u128::from(numbers.next_u64()) * parts as u128 / (1 << 64);
        Box::new(move |full: &FullSet| Some(part(full.held().len()) as usize))
    }
    fn draws_random_numbers(&self) -> bool {
        true
    }
}

/// One sequence of random numbers for all sets: each eviction takes the next.
struct Draws {
    sequence: pm_random::Random,
    ways: u64,
}

impl Draws {
    fn new(seed: u64, ways: usize) -> Self {
        Self { sequence: pm_random::Random::new(&[seed]), ways: ways as u64 }
    }
}

impl Replacement for Draws {
    const REPEATS_MATTER: bool = false;

    #[inline]
    fn hit(&mut self, _: usize, _: usize) {}

    #[inline]
    fn fill(&mut self, _: usize, _: usize) {}

    #[inline]
    fn victim(&mut self, _: usize) -> usize {
        // The upper half of the product is even over the ways to one part in 2^32 (there are fewer than 2^32).
        ((u128::from(self.sequence.next_u64()) * u128::from(self.ways)) >> 64) as usize
    }
}
