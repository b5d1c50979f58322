//! Misses in the order they happen, and what follows them: chains in which one waits for another, changes of DRAM pages, rows of DRAM banks, a trace of what is
//! fetched.

mod chains;
mod dram;
mod page_switches;
mod stream;
#[cfg(test)]
mod tests;

pub(crate) use chains::{Chains, Waiting};
pub(crate) use dram::Banks;
pub use dram::{BankMap, Dram, DramCounts, DramError, RowPolicy};
pub(crate) use page_switches::PageSwitches;
pub use stream::{MissStream, MissStreamError};
pub(crate) use stream::{access_of, hold_lines};

/// The misses of the chunk in hand, for whoever wants to follow them.
#[derive(Debug, Default)]
pub struct Misses {
    wanted: bool,
    list: Vec<Miss>,
    /// Dirty lines that left, in the order of the misses that they made room for.
    written_back: Vec<WrittenBack>,
}

/// One line access that missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Miss {
    /// Index of the line access in the chunk.
    pub(crate) index: u32,
    /// It missed in the first so many caches of the model.
    pub(crate) caches: u32,
}

/// A dirty line that made room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct WrittenBack {
    /// Index of the line access in the chunk that missed.
    pub(crate) index: u32,
    /// The region that the line was last written in.
    pub(crate) region: u16,
    pub(crate) slot: u32,
}

impl Misses {
    /// A list that is kept only if `wanted`.
    pub(crate) fn new(wanted: bool) -> Self {
        Self { wanted, ..Self::default() }
    }

    /// The line access at `index` missed in the first `caches` caches of the model. Called in the order of the accesses,
    /// during warm-up too.
    #[inline]
    pub fn push(&mut self, index: usize, caches: usize) {
        if self.wanted {
            self.list.push(Miss { index: index as u32, caches: caches as u32 });
        }
    }

    /// A dirty line of the first cache, last written in `region`, made room for the miss at `index`. Called before or after
    /// [`push`](Self::push) of that miss, in the order of the accesses.
    #[inline]
    pub fn write_back(&mut self, index: usize, region: usize, slot: u32) {
        if self.wanted {
            self.written_back.push(WrittenBack { index: index as u32, region: region as u16, slot });
        }
    }

    pub(crate) fn written_back(&self) -> &[WrittenBack] {
        &self.written_back
    }

    pub(crate) fn list(&self) -> &[Miss] {
        &self.list
    }

    pub(crate) fn clear(&mut self) {
        self.list.clear();
        self.written_back.clear();
    }
}
