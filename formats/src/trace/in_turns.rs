//! Reads of whole records of several regions in turns, as one integer each.
//!
//! It is how far the record lies from the one read last of its region (zigzag), and below that, in as few bits as it takes,
//! which of the regions it is of. A search that goes back and forth between nodes and leaves, or between buckets and blocks,
//! so costs nothing for the change itself, and each region has small differences of its own.

use super::access::{Access, TraceSink};
use super::varint::{push, take_fast, unzigzag, zigzag};
use crate::region::{Coding, Region};

/// The regions that are read in turns, and the record read last of each.
pub(super) struct InTurns {
    /// Bits that tell which region.
    bits: u32,
    regions: Vec<InTurn>,
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
    pub(super) fn of(regions: &[Region]) -> Self {
        let in_turns = regions.iter().zip(0..).filter(|(region, _)| region.coding == Coding::InTurns);
        let regions: Vec<InTurn> = in_turns
            .map(|(region, number)| {
                let records = region.size.checked_div(region.record_size.into()).unwrap_or(0);
                InTurn { number, record_size: region.record_size, records, last: 0 }
            })
            .collect();
        Self { bits: regions.len().next_power_of_two().trailing_zeros(), regions }
    }

    /// A search begins: nothing was read before.
    #[inline]
    pub(super) fn restart(&mut self) {
        self.regions.iter_mut().for_each(|region| region.last = 0);
    }

    /// Codes the read of a record of the region that has this number among those in turns.
    pub(super) fn encode(&mut self, rank: u16, record: u32, bytes: &mut Vec<u8>) {
        let region = &mut self.regions[usize::from(rank)];
        let record = i64::from(record);
        push(bytes, zigzag(record - region.last) << self.bits | u64::from(rank));
        region.last = record;
    }

    /// Tells of `count` reads; `None` if they are not there or beyond their region.
    #[inline]
    pub(super) fn decode(&mut self, count: u64, bytes: &mut &[u8], sink: &mut impl TraceSink) -> Option<()> {
        let of_rank = (1u64 << self.bits) - 1;
        for _ in 0..count {
            let token = take_fast(bytes)?;
            let region = self.regions.get_mut((token & of_rank) as usize)?;
            // Beyond 2^63 it is negative, and that is beyond any region.
            let record = region.last.wrapping_add(unzigzag(token >> self.bits));
            if record as u64 >= region.records {
                return None;
            }
            region.last = record;
            sink.access(Access::read(region.number, record as u64 * u64::from(region.record_size), region.record_size));
        }
        Some(())
    }
}
