//! Misses in the order they happen, and what follows them: changes of DRAM pages, rows of DRAM banks, a trace of what is
//! fetched.

mod dram;
mod page_switches;
mod stream;
#[cfg(test)]
mod tests;

pub(crate) use dram::Banks;
pub use dram::{BankMap, Dram, DramCounts, DramError, RowPolicy};
pub(crate) use page_switches::PageSwitches;
pub use stream::{MissStream, MissStreamError};

/// The misses of the chunk in hand, for whoever wants to follow them.
#[derive(Debug, Default)]
pub struct Misses {
    wanted: bool,
    list: Vec<Miss>,
}

/// One line access that missed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Miss {
    /// Index of the line access in the chunk.
    pub(crate) index: u32,
    /// It missed in the first so many caches of the model.
    pub(crate) caches: u32,
}

impl Misses {
    /// A list that is kept only if `wanted`.
    pub(crate) fn new(wanted: bool) -> Self {
        Self { wanted, list: vec![] }
    }

    /// The line access at `index` missed in the first `caches` caches of the model. Called in the order of the accesses,
    /// during warm-up too.
    #[inline]
    pub fn push(&mut self, index: usize, caches: usize) {
        if self.wanted {
            self.list.push(Miss { index: index as u32, caches: caches as u32 });
        }
    }

    pub(crate) fn list(&self) -> &[Miss] {
        &self.list
    }

    pub(crate) fn clear(&mut self) {
        self.list.clear();
    }
}
