//! Fully associative LRU, of one size or of many sizes at once.
//!
//! Caches of the same line under LRU include one another: the C lines last used are in every cache of at least C lines
//! (Mattson, Gecsei, Slutz and Traiger 1970). So one stack of lines by recency serves all sizes. It is cut into *levels*:
//! the first holds what the smallest cache holds, each next one what its size adds. An access that finds its line in level
//! d misses in the d smaller caches and hits in the others.
//!
//! The usual stack is a linked list in which every hit moves its line to the front. Here a hit writes down one number, the
//! time of the line's last use. A line is in the first level if that time is not before the level's *tail*, the time of the
//! oldest line in it; only a miss has to find out which line that is. The trace itself is the list of candidates: an entry
//! of it whose time is still its line's last use stands for that line, any other is dead. The candidates of a level form a
//! queue in order of time; those of the first level are taken from the chunk in hand, live ones only, when a miss runs out
//! of them and at the end of the chunk. Every access is looked at once more there, but without a branch, and by then most
//! uses are dead and leave nothing to do.
//!
//! One stack also beats one simulator for each size: the seven in ten accesses that hit the smallest cache do nothing for
//! the larger ones, while separate simulators would look each of them up again (`cargo bench --bench cache` has both).

mod level;
mod pending;
mod queue;
#[cfg(test)]
mod tests;

use level::{Level, depth_of, make_room};
use pending::Pending;
use queue::{FIRST_TIME, GONE, LastUse, NEVER, Queue, Use};

use super::{CacheModel, LineCounts};
use crate::{
    lines::{LineChunk, LineSpace, grow},
    misses::Misses,
};

/// Fully associative LRU caches of one line size.
pub(crate) struct LruStack {
    /// By slot: when it was last used.
    last: Vec<u32>,
    levels: Vec<Level>,
    now: u32,
    /// Times stay below this; on reaching it, they are numbered anew.
    horizon: u32,
    regions: usize,
    /// Counted accesses by how many of the caches they missed in, then by region.
    missed: Vec<u64>,
    /// Counted first touches.
    compulsory: u64,
    /// Dirtiness; empty until there is a write.
    dirt: Vec<u16>,
    /// Counted writes by how many of the caches they turned the line dirty in.
    dirtied: Vec<u64>,
}

/// The most sizes one stack takes.
pub(crate) const MAX_SIZES: usize = u16::MAX as usize;

impl LruStack {
    /// Caches that hold so many lines each: at least one size, at most [`MAX_SIZES`], ascending and all different.
    pub(crate) fn new(space: &LineSpace, regions: usize, sizes: &[u64]) -> Self {
        assert!(!sizes.is_empty() && sizes.len() <= MAX_SIZES && sizes.is_sorted_by(|a, b| a < b) && sizes[0] > 0);
        let mut smaller = 0;
        let level = |&size: &u64| {
            let capacity = size - std::mem::replace(&mut smaller, size);
            Level { capacity, lines: 0, tail: GONE, queue: Queue::default() }
        };
        Self {
            last: vec![NEVER; space.slots() as usize],
            levels: sizes.iter().map(level).collect(),
            now: FIRST_TIME,
            horizon: u32::MAX,
            regions,
            missed: vec![0; (sizes.len() + 1) * regions],
            compulsory: 0,
            dirt: Vec::new(),
            dirtied: vec![0; sizes.len() + 1],
        }
    }

    /// The loop over a chunk whose times fit below the horizon.
    ///
    /// Whether there are writes, and whether there is one size only, is settled outside of the loop: that
    /// makes the most common case, reads through one cache, a quarter faster.
    fn pass<const WRITES: bool, const ONE_SIZE: bool>(
        &mut self,
        chunk: &LineChunk,
        counted: bool,
        misses: &mut Misses,
    ) {
        let (slots, start) = (chunk.slots(), self.now);
        let last = LastUse(&mut self.last);
        let mut pending = Pending { slots, start, seen: 0 };
        let mut tail = self.levels[0].tail;
        for (i, &slot) in slots.iter().enumerate() {
            let before = std::mem::replace(&mut last.0[slot as usize], start + i as u32);
            let mut depth = 0;
            if before < tail {
                if ONE_SIZE {
                    depth = 1;
                    self.levels[0].admit(&mut pending, i, &last);
                } else {
                    depth = depth_of(&self.levels, before);
                    make_room(&mut self.levels, depth, &mut pending, i, &last);
                }
                tail = self.levels[0].tail;
                misses.push(i, depth);
                self.missed[depth * self.regions + chunk.attributes(i).region()] += u64::from(counted);
                self.compulsory += u64::from(counted && before == NEVER);
            }
            if WRITES {
                // The caches a line is dirty in are always the largest ones, since a fetch makes it clean in the smaller
                // and a write dirty in all: `dirt` is the number of caches it is clean or absent in.
                let dirt = &mut self.dirt[slot as usize];
                *dirt = (*dirt).max(depth as u16);
                if counted && chunk.attributes(i).writes() {
                    self.dirtied[usize::from(*dirt)] += 1;
                    *dirt = 0;
                }
            }
        }
        if let Some(first) = self.levels.first_mut() {
            pending.move_to(&mut first.queue, slots.len(), &last);
        }
        self.now = start + slots.len() as u32;
    }

    /// Numbers the live uses from the first time on, in the same order, so that times never run out.
    #[cold]
    fn renumber(&mut self) {
        let last = LastUse(&mut self.last);
        let mut live: Vec<Vec<Use>> = self.levels.iter().map(|l| l.queue.live(&last).collect()).collect();
        last.0.iter_mut().filter(|t| **t != NEVER).for_each(|t| *t = GONE);
        self.now = FIRST_TIME;
        // The deepest level is the oldest.
        for (level, uses) in self.levels.iter_mut().zip(&mut live).rev() {
            level.tail = self.now;
            for u in &mut *uses {
                u.time = self.now;
                last.0[u.slot as usize] = self.now;
                self.now += 1;
            }
            level.queue = Queue { head: 0, tail: uses.len(), uses: std::mem::take(uses) };
        }
    }
}

impl CacheModel for LruStack {
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        grow(&mut self.last, space, NEVER);
        if (self.horizon - self.now) as usize <= chunk.slots().len() {
            self.renumber();
        }
        if chunk.writes() && self.dirt.is_empty() {
            self.dirt = vec![self.levels.len() as u16; self.last.len()];
        } else if !self.dirt.is_empty() {
            grow(&mut self.dirt, space, self.levels.len() as u16);
        }
        // A trace without writes, which most are, never looks at dirtiness.
        match (self.dirt.is_empty(), self.levels.len() == 1) {
            (true, true) => self.pass::<false, true>(chunk, counted, misses),
            (true, false) => self.pass::<false, false>(chunk, counted, misses),
            (false, true) => self.pass::<true, true>(chunk, counted, misses),
            (false, false) => self.pass::<true, false>(chunk, counted, misses),
        }
    }

    fn finish(self: Box<Self>) -> Vec<LineCounts> {
        let size = |i: usize| {
            let mut counts = LineCounts { compulsory: self.compulsory, ..LineCounts::new(self.regions) };
            // Size i misses what more than i sizes missed.
            for missed in self.missed.chunks(self.regions.max(1)).skip(i + 1) {
                counts.fetches.iter_mut().zip(missed).for_each(|(sum, n)| *sum += n);
            }
            counts.write_backs = self.dirtied[i + 1..].iter().sum();
            counts
        };
        (0..self.levels.len()).map(size).collect()
    }

    fn repeats_matter(&self) -> bool {
        false
    }
}
