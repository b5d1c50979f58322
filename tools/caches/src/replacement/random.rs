//! Evicts any line of the set.

use super::Replacement;

/// One sequence of random numbers for all sets: each eviction takes the next.
pub(in super::super) struct Random {
    sequence: pm_random::Random,
    ways: u64,
}

impl Random {
    pub(in super::super) fn new(seed: u64, ways: usize) -> Self {
        Self { sequence: pm_random::Random::new(&[seed]), ways: ways as u64 }
    }
}

impl Replacement for Random {
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
