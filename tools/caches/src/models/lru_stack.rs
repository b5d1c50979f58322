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

mod growing;
mod level;
mod pending;
mod queue;
#[cfg(test)]
mod tests;
mod times;

use growing::Growing;
use level::{Level, depth_of, make_room};
use pending::Pending;
use queue::{FIRST_TIME, GONE, Queue, Use};
use times::{OfLines, Times};

use super::{CacheModel, LineCounts};
use crate::{
    lines::{LineChunk, LineSpace},
    misses::Misses,
};

/// Fully associative LRU caches of one line size.
struct LruStack<T> {
    /// When lines were last used.
    last: T,
    levels: Vec<Level>,
    now: u32,
    /// Times stay below this; on reaching it, they are numbered anew.
    horizon: u32,
    regions: usize,
    /// Counted accesses by how many of the caches they missed in, then by region.
    missed: Vec<u64>,
    /// Counted first touches.
    compulsory: u64,
    /// Dirtiness, by the line's place beside its time; empty until there is a write.
    dirt: Vec<u16>,
    /// Counted writes by how many of the caches they turned the line dirty in.
    dirtied: Vec<u64>,
}

/// The most sizes one stack takes.
pub(crate) const MAX_SIZES: usize = u16::MAX as usize;

/// Caches that hold so many lines each: at least one size, at most [`MAX_SIZES`], ascending and all different.
pub(crate) fn lru_stack(space: &LineSpace, regions: usize, sizes: &[u64]) -> Box<dyn CacheModel> {
    match space.grows() {
        true => Box::new(Growing::OfLines(LruStack::new(space, regions, sizes))),
        false => Box::new(LruStack::<OfLines>::new(space, regions, sizes)),
    }
}

impl<T: Times> LruStack<T> {
    /// As [`lru_stack`].
    fn new(space: &LineSpace, regions: usize, sizes: &[u64]) -> Self {
        assert!(!sizes.is_empty() && sizes.len() <= MAX_SIZES && sizes.is_sorted_by(|a, b| a < b) && sizes[0] > 0);
        let mut smaller = 0;
        let level = |&size: &u64| {
            let capacity = size - std::mem::replace(&mut smaller, size);
            Level { capacity, lines: 0, tail: GONE, queue: Queue::default() }
        };
        Self {
            last: T::new(space),
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
        self.last.ahead(slots);
        let last = &mut self.last;
        let mut pending = Pending { slots, start, seen: 0 };
        let mut tail = self.levels[0].tail;
        for (i, &slot) in slots.iter().enumerate() {
            let before = last.replace(slot, start + i as u32);
            let mut depth = 0;
            if before < tail {
                depth = if ONE_SIZE { 1 } else { depth_of(&self.levels, before) };
                if ONE_SIZE || depth == self.levels.len() {
                    let first = last.comes(slot, before);
                    self.compulsory += u64::from(counted && first);
                }
                let out = match ONE_SIZE {
                    true => self.levels[0].admit(&mut pending, i, last),
                    false => make_room(&mut self.levels, depth, &mut pending, i, last),
                };
                if let Some(out) = out {
                    last.leaves(out.slot);
                }
                tail = self.levels[0].tail;
                misses.push(i, depth);
                self.missed[depth * self.regions + chunk.attributes(i).region()] += u64::from(counted);
            }
            if WRITES {
                // The caches a line is dirty in are always the largest ones, since a fetch makes it clean in the smaller
                // and a write dirty in all: `dirt` is the number of caches it is clean or absent in.
                let place = last.place(slot);
                if place >= self.dirt.len() {
                    self.dirt.resize(last.places(), self.levels.len() as u16);
                }
                let dirt = &mut self.dirt[place];
                *dirt = (*dirt).max(depth as u16);
                if counted && chunk.attributes(i).writes() {
                    self.dirtied[usize::from(*dirt)] += 1;
                    *dirt = 0;
                }
            }
        }
        if let Some(first) = self.levels.first_mut() {
            pending.move_to(&mut first.queue, slots.len(), last);
        }
        self.now = start + slots.len() as u32;
    }

    /// Numbers the live uses from the first time on, in the same order, so that times never run out.
    #[cold]
    fn renumber(&mut self) {
        let last = &mut self.last;
        let mut live: Vec<Vec<Use>> = self.levels.iter().map(|l| l.queue.live(last).collect()).collect();
        last.forget();
        self.now = FIRST_TIME;
        // The deepest level is the oldest.
        for (level, uses) in self.levels.iter_mut().zip(&mut live).rev() {
            level.tail = self.now;
            for u in &mut *uses {
                u.time = self.now;
                last.replace(u.slot, self.now);
                self.now += 1;
            }
            level.queue = Queue { head: 0, tail: uses.len(), uses: std::mem::take(uses) };
        }
    }
}

impl<T: Times> CacheModel for LruStack<T> {
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        self.last.grow(space);
        if (self.horizon - self.now) as usize <= chunk.slots().len() {
            self.renumber();
        }
        if chunk.writes() && self.dirt.is_empty() {
            self.dirt = vec![self.levels.len() as u16; self.last.places().max(1)];
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
