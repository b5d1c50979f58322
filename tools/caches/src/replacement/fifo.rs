//! Evicts the line of the set that came first.

use super::Replacement;

/// The way whose turn it is, by set. Ways are filled in order, so they are emptied in order, round and round.
pub(in super::super) struct Fifo {
    next: Vec<u32>,
    ways: u32,
}

impl Fifo {
    pub(in super::super) fn new(sets: usize, ways: usize) -> Self {
        Self { next: vec![0; sets], ways: ways as u32 }
    }
}

impl Replacement for Fifo {
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
