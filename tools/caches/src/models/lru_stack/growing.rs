//! The stack of a trace whose pages become more: a time for each line, until there are many.

use super::LruStack;
use super::times::{OfLines, OfPages, Times as _};
use crate::lines::{LineChunk, LineSpace};
use crate::misses::Misses;
use crate::models::{CacheModel, LineCounts};

/// Lines with a time each: a few MiB, which a core's caches nearly hold, and which cost one look and not two.
pub(super) const MANY: u64 = 1 << 21;

/// A stack that begins as one of all lines.
pub(super) enum Growing {
    OfLines(LruStack<OfLines>),
    OfPages(LruStack<OfPages>),
    /// On its way from one to the other.
    Neither,
}

impl Growing {
    /// The same with the times of all lines replaced by those of the pages that the caches hold lines of.
    pub(super) fn with_pages(stack: LruStack<OfLines>, space: &LineSpace) -> LruStack<OfPages> {
        let tail = stack.levels.last().expect("a size at least").tail;
        let last = OfPages::of_held(&stack.last, tail, space);
        let mut dirt = vec![];
        if !stack.dirt.is_empty() {
            dirt.resize(last.places().max(1), stack.levels.len() as u16);
            for slot in last.placed().filter(|&slot| (slot as usize) < stack.dirt.len()) {
                dirt[last.place(slot)] = stack.dirt[slot as usize];
            }
        }
        let LruStack { levels, now, horizon, regions, missed, compulsory, dirtied, .. } = stack;
        LruStack { last, levels, now, horizon, regions, missed, compulsory, dirt, dirtied }
    }
}

impl CacheModel for Growing {
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        if space.slots() > MANY && matches!(self, Self::OfLines(_)) {
            *self = match std::mem::replace(self, Self::Neither) {
                Self::OfLines(stack) => Self::OfPages(Self::with_pages(stack, space)),
                other => other,
            };
        }
        match self {
            Self::OfLines(stack) => stack.run(space, chunk, counted, misses),
            Self::OfPages(stack) => stack.run(space, chunk, counted, misses),
            Self::Neither => unreachable!("it arrives where it goes"),
        }
    }

    fn finish(self: Box<Self>) -> Vec<LineCounts> {
        match *self {
            Self::OfLines(stack) => Box::new(stack).finish(),
            Self::OfPages(stack) => Box::new(stack).finish(),
            Self::Neither => unreachable!("it arrives where it goes"),
        }
    }

    fn repeats_matter(&self) -> bool {
        false
    }
}
