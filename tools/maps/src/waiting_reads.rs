//! What a search read, and what each read waits for.

use super::{AccessObserver, SearchReads};
use pm_formats::trace::Waits;

/// Remembers the reads of one search, and what each waits for: an observer of its own, so that whoever does not ask does not
/// pay.
pub struct WaitingReads<'a> {
    reads: &'a mut SearchReads,
    waits: &'a mut Vec<Waits>,
    /// Does the next read begin another attempt?
    again: bool,
}

impl<'a> WaitingReads<'a> {
    /// Remembers in these, which then hold nothing else: `waits` has one for each of the reads, in order.
    #[must_use]
    pub fn new(reads: &'a mut SearchReads, waits: &'a mut Vec<Waits>) -> Self {
        reads.clear();
        waits.clear();
        Self { reads, waits, again: false }
    }
}

impl AccessObserver for WaitingReads<'_> {
    fn read(&mut self, region: u16, record: u32) {
        self.read_after(region, record, Waits::NOTHING);
    }

    fn read_after(&mut self, region: u16, record: u32, waits: Waits) {
        let first = std::mem::take(&mut self.again);
        self.waits.push(if first && waits == Waits::NOTHING { Waits::ALL_BEFORE } else { waits });
        self.reads.read(region, record);
    }

    fn again(&mut self) {
        self.again = true;
    }

    fn reread(&mut self, region: u16, record: u32) {
        let before = self.reads.len();
        self.reads.reread(region, record);
        // Where second touches count as reads, they wait for nothing that is not there.
        self.waits.resize(self.waits.len() + (self.reads.len() - before), Waits::NOTHING);
    }

    fn examined(&mut self, photons: usize) {
        self.reads.examined(photons);
    }
}

#[cfg(test)]
mod tests;
