//! Belady's optimum, without looking ahead.
//!
//! Belady's MIN evicts the line whose next use is farthest, so it seems to have to know the future. What it *misses* can be
//! told from the past (Jain and Lin, *Back to the Future*, ISCA 2016, predict with this): call the time from one use of a
//! line to its next a *stay*. MIN keeps the stays that end first, as many at a time as there are frames; so when a stay
//! ends, all that could have been in its way have ended before, and whether it could be kept is known at that very access.
//! To keep as many stays as possible, in order of their ends, is to schedule intervals on identical machines: each frame
//! remembers since when it is free, and a stay takes, of the frames that were free when it began, the one that was freed
//! last (Carlisle and Lloyd, *On the k-coloring of intervals*, 1995; Faigle and Nawijn 1995). If there is none, the line is
//! fetched again. The stays kept are those that Belady's rule keeps, one by one, not only as many: so fetches by region and
//! write-backs are exact too. One reading of the trace suffices, and memory for each line of it.
//!
//! *Time* is counted in misses, by set: between two misses the cache does not change, hence a line that was used since the
//! last miss is there. A line fetched occupies a frame until the next miss: so one frame less is left for stays to take,
//! and the first miss in a stay's way is the one *after* the access it begins with. Where fetched lines may pass by
//! (`min-bypass`), stays have all frames, and one that begins with a miss needs its frame from that miss on. A line that
//! passes by stays at hand until another line is accessed: consecutive accesses to a line are one use.
//!
//! Lines without a next use have no stay and never take a frame, whichever of them Belady's rule evicts first.

mod few_ways;
mod one_set;

pub(crate) use {few_ways::FewWays, one_set::OneSet};

use super::{CacheModel, LineCounts};
use crate::{
    lines::{LineChunk, LineSpace, grow},
    misses::Misses,
};

/// What an access finds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Found {
    /// Its line, kept since the last use.
    Kept,
    /// Not its line, which was used before.
    Gone,
    /// Not its line, which was never used.
    New,
}

/// The frames of all sets, free since when, and when each line was last used.
pub(crate) trait Frames {
    /// Uses the line of `slot`, whose line number is `line()`.
    fn touch(&mut self, slot: u32, line: impl FnOnce() -> u64) -> Found;

    /// There are as many slots as `space` has now.
    fn grow(&mut self, space: &LineSpace);
}

/// Which lines may stay in no frame at all.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bypass {
    /// None: every line fetched is put in a frame.
    Never,
    /// Any.
    Allowed,
}

impl Bypass {
    /// How many of `ways` frames are free for stays while a line is fetched.
    fn free(self, ways: usize) -> usize {
        match self {
            Self::Never => ways - 1,
            Self::Allowed => ways,
        }
    }

    /// From how many times before now on a stay needs a frame, if it begins with the miss that just made it now.
    fn earlier(self) -> u8 {
        match self {
            Self::Never => 0,
            Self::Allowed => 1,
        }
    }
}

/// A cache under Belady's optimum.
pub(crate) struct Optimum<F> {
    frames: F,
    bypass: Bypass,
    /// The slot of the last access.
    before: Option<u32>,
    /// By slot; empty until there is a write.
    dirty: Vec<bool>,
    counts: LineCounts,
}

impl<F: Frames> Optimum<F> {
    /// `frames` was made with the same `bypass`.
    pub(crate) fn new(regions: usize, bypass: Bypass, frames: F) -> Self {
        Self { frames, bypass, before: None, dirty: Vec::new(), counts: LineCounts::new(regions) }
    }

    fn pass<const WRITES: bool>(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        for (i, &slot) in chunk.slots().iter().enumerate() {
            // Whether a repeat is in the chunk depends on where it begins: to bypass, none may make a difference.
            let repeats = self.bypass == Bypass::Allowed && self.before == Some(slot);
            self.before = Some(slot);
            let attributes = chunk.attributes(i);
            if !repeats {
                let found = self.frames.touch(slot, || space.line(attributes.region(), slot));
                if found != Found::Kept {
                    misses.push(i, 1);
                    self.counts.fetches[attributes.region()] += u64::from(counted);
                    self.counts.compulsory += u64::from(counted && found == Found::New);
                    if WRITES {
                        self.dirty[slot as usize] = false;
                    }
                }
            }
            if WRITES && counted && attributes.writes() {
                let dirty = std::mem::replace(&mut self.dirty[slot as usize], true);
                self.counts.write_backs += u64::from(!dirty);
            }
        }
    }
}

impl<F: Frames> CacheModel for Optimum<F> {
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        self.frames.grow(space);
        if chunk.writes() || !self.dirty.is_empty() {
            grow(&mut self.dirty, space, false);
        }
        // A trace without writes, which most are, never looks at dirtiness.
        if self.dirty.is_empty() {
            self.pass::<false>(space, chunk, counted, misses);
        } else {
            self.pass::<true>(space, chunk, counted, misses);
        }
    }

    fn finish(self: Box<Self>) -> Vec<LineCounts> {
        vec![self.counts]
    }

    fn repeats_matter(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests;
