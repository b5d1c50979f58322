//! Reads of whole records of several regions in turns, as one integer each.
//!
//! It is how far the record lies from the one read last of its region (zigzag), and below that, in as few bits as it takes,
//! which of the regions it is of. A search that goes back and forth between nodes and leaves, or between buckets and blocks,
//! so costs nothing for the change itself, and each region has small differences of its own.

use super::Waits;
use super::access::Access;
use super::batch::Batch;
use super::varint::{push, take_fast, unzigzag, zigzag};
use crate::region::{Coding, Region};

/// The regions that are read in turns, and the record read last of each.
pub(super) struct InTurns {
    /// Bits that tell which region.
    bits: u32,
    regions: Vec<InTurn>,
    /// Does each read say what it waits for?
    waiting: bool,
    /// Levels that the search has reads at.
    levels: u16,
}

/// One of them.
struct InTurn {
    number: u16,
    record_size: u32,
    /// Whole records that it has room for.
    records: u64,
    last: i64,
}

impl InTurns {
    /// Of the regions of a trace.
    pub(super) fn of(of: &[Region]) -> Self {
        let in_turns = of.iter().zip(0..).filter(|(region, _)| region.is_in_turns());
        let regions: Vec<InTurn> = in_turns
            .map(|(region, number)| {
                let records = region.size.checked_div(region.record_size.into()).unwrap_or(0);
                InTurn { number, record_size: region.record_size, records, last: 0 }
            })
            .collect();
        let waiting = of.iter().any(|region| region.coding == Coding::Waiting);
        Self { bits: regions.len().next_power_of_two().trailing_zeros(), regions, waiting, levels: 0 }
    }

    /// A search begins: nothing was read before.
    #[inline]
    pub(super) fn restart(&mut self) {
        self.levels = 0;
        self.regions.iter_mut().for_each(|region| region.last = 0);
    }

    /// Codes the read of a record of the region that has this number among those in turns. What it waits for is left out where
    /// the coding has no place for it.
    ///
    /// # Panics
    /// If it waits for a level that nothing was read at.
    pub(super) fn encode(&mut self, rank: u16, record: u32, waits: Waits, bytes: &mut Vec<u8>) {
        if self.waiting {
            assert!(waits.level() <= self.levels, "a read waits for a level that has none");
            self.levels = self.levels.max(waits.level() + 1);
            push(bytes, waits.code());
        }
        let region = &mut self.regions[usize::from(rank)];
        let record = i64::from(record);
        push(bytes, zigzag(record - region.last) << self.bits | u64::from(rank));
        region.last = record;
    }

    /// Tells of `count` reads; `None` if they are not there or beyond their region.
    pub(super) fn decode(&mut self, count: u64, bytes: &mut &[u8], batch: &mut Batch<'_>) -> Option<()> {
        if self.waiting {
            for _ in 0..count {
                let waits = Waits::of_code(take_fast(bytes)?, self.levels)?;
                self.levels = self.levels.max(waits.level() + 1);
                batch.waits(waits);
                batch.access(self.take(bytes)?);
            }
            return Some(());
        }
        for _ in 0..count {
            batch.access(self.take(bytes)?);
        }
        Some(())
    }

    /// The next read.
    #[inline(always)]
    fn take(&mut self, bytes: &mut &[u8]) -> Option<Access> {
        let token = take_fast(bytes)?;
        let rank = token & ((1 << self.bits) - 1);
        let region = self.regions.get_mut(rank as usize)?;
        // Beyond 2^63 it is negative, and that is beyond any region.
        let record = region.last.wrapping_add(unzigzag(token >> self.bits));
        if record as u64 >= region.records {
            return None;
        }
        region.last = record;
        Some(Access::read(region.number, record as u64 * u64::from(region.record_size), region.record_size))
    }
}
