//! The miss curve: what fully associative LRU caches of every size fetch, from one pass.
//!
//! An access of stack distance d misses in the caches of at most d lines, a first touch in all; so the fetches of a cache
//! of C lines are the counted accesses of distance C or more. Write-backs come from the same pass (Thompson and Smith,
//! *Efficient (stack) algorithms for analysis of write-back and sector memories*, ACM TOCS 7, 1989): a line is dirty in
//! the caches larger than the greatest distance it was used at since it was last written, so a write turns it dirty in
//! the others, and each of these writes it back once.

use super::{Curve, Histogram, StackDistances, TraceCounts};
use crate::lines::LineChunk;

/// Collects the curve of one line size.
pub(crate) struct CurveCollector {
    distances: StackDistances,
    accesses: Histogram,
    /// By slot: the greatest distance since the last counted write, [`CLEAN`] before that. Empty until there is a write.
    dirt: Vec<u32>,
    dirtied: Histogram,
}

/// Dirty in no cache.
const CLEAN: u32 = u32::MAX;

impl CurveCollector {
    /// The curve of lines numbered below `slots`.
    pub(crate) fn new(slots: u64) -> Self {
        let distances = StackDistances::new(slots);
        Self { distances, accesses: Histogram::default(), dirt: vec![], dirtied: Histogram::default() }
    }

    /// Runs the line accesses of `chunk`, below `slots`; `counted` is false during warm-up, when only the state changes.
    pub(crate) fn run(&mut self, slots: u64, chunk: &LineChunk, counted: bool) {
        self.distances.grow(slots);
        if chunk.writes() || !self.dirt.is_empty() {
            self.dirt.resize(slots as usize, CLEAN);
        }
        // An access that repeats the one before may be left out of the chunk; its distance is 0.
        self.accesses.reserve(1);
        self.accesses.at[0] += if counted { chunk.accesses() - chunk.slots().len() as u64 } else { 0 };
        match self.dirt.is_empty() {
            true => self.pass::<false>(chunk, counted),
            false => self.pass::<true>(chunk, counted),
        }
    }

    fn pass<const WRITES: bool>(&mut self, chunk: &LineChunk, counted: bool) {
        for (i, &slot) in chunk.slots().iter().enumerate() {
            let distance = self.distances.touch(slot);
            self.accesses.add(distance, &self.distances, counted);
            if WRITES {
                let dirt = &mut self.dirt[slot as usize];
                *dirt = (*dirt).max(distance.unwrap_or(CLEAN));
                if counted && chunk.attributes(i).writes() {
                    match std::mem::replace(dirt, 0) {
                        CLEAN => self.dirtied.never += 1,
                        // Dirty in every cache of a line or more.
                        0 => {}
                        greatest => {
                            self.dirtied.reserve(self.distances.touched());
                            self.dirtied.at[greatest as usize] += 1;
                        }
                    }
                }
            }
        }
    }

    /// The curve, given what is the same for all sizes.
    pub(crate) fn finish(self, trace: TraceCounts) -> Curve {
        let compulsory = self.accesses.never;
        Curve { trace, compulsory, fetches: self.accesses.at_least(), write_backs: self.dirtied.at_least() }
    }
}
