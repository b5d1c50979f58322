//! From byte addresses to lines: the numbering models work with, and the splitting of records that span lines.

use pm_formats::trace::Region;

/// Numbers the lines of all regions without gaps, so that a model can keep a table indexed by line.
///
/// The number is called a *slot*. Gaps between regions, however wide, have no slots; lines that two regions share (which
/// takes lines longer than the 4 KiB that keep regions apart) have one.
#[derive(Debug)]
pub(super) struct LineSpace {
    /// log2 of the line in bytes.
    shift: u32,
    /// For each region: line number minus slot, modulo 2^64.
    delta: Vec<u64>,
    slots: u64,
}

impl LineSpace {
    /// Slots for lines of `line_bytes` (a power of two). No region may reach past the last address.
    pub(super) fn new(regions: &[Region], line_bytes: u32) -> Self {
        let shift = line_bytes.ilog2();
        let mut by_base: Vec<usize> = (0..regions.len()).filter(|&r| regions[r].size > 0).collect();
        by_base.sort_by_key(|&r| regions[r].base);

        let mut delta = vec![0; regions.len()];
        let (mut slots, mut here, mut previous) = (0_u64, 0_u64, None);
        for r in by_base {
            let first = regions[r].base >> shift;
            let last = (regions[r].base + (regions[r].size - 1)) >> shift;
            if previous.is_none_or(|p| first > p) {
                here = first.wrapping_sub(slots);
            }
            // Slots of a shared line, or of a region within another, are already there.
            slots = slots.max(last.wrapping_sub(here) + 1);
            previous = previous.max(Some(last));
            delta[r] = here;
        }
        Self { shift, delta, slots }
    }

    /// Number of slots.
    pub(super) fn slots(&self) -> u64 {
        self.slots
    }

    /// The slot of the line at a byte address of a region.
    #[inline]
    fn slot(&self, region: u16, address: u64) -> u32 {
        (address >> self.shift).wrapping_sub(self.delta[region as usize]) as u32
    }

    /// The line number (byte address / line bytes) of a slot that an access to `region` touched.
    #[inline]
    pub(super) fn line(&self, region: u16, slot: u32) -> u64 {
        u64::from(slot).wrapping_add(self.delta[region as usize])
    }
}

/// One access of the trace, its address worked out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record {
    /// Region base plus offset.
    pub(super) address: u64,
    pub(super) len: u32,
    pub(super) region: u16,
    pub(super) kind: pm_formats::trace::AccessKind,
}

/// What a line access is besides its slot: the region, and whether the line turns dirty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tag(u32);

impl Tag {
    fn new(record: &Record) -> Self {
        let writes = record.kind != pm_formats::trace::AccessKind::Read;
        Self(u32::from(record.region) << 1 | u32::from(writes))
    }

    /// The region accessed.
    #[inline]
    pub(super) fn region(self) -> u16 {
        (self.0 >> 1) as u16
    }

    /// Whether the access is a write or a read-modify-write.
    #[inline]
    pub(super) fn writes(self) -> bool {
        self.0 & 1 != 0
    }
}

/// Records still to be split into line accesses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest<'a> {
    records: &'a [Record],
    /// Lines of the first record that are done.
    lines_taken: u32,
}

impl<'a> From<&'a [Record]> for Rest<'a> {
    fn from(records: &'a [Record]) -> Self {
        Self { records, lines_taken: 0 }
    }
}

/// How many lines of a record longer than a line are split off at a time. At least 2.
const MAX_LONG: usize = 4096;

/// The line accesses of a stretch of the trace.
///
/// A line access that repeats the one before in every respect is left out (one in seven in a tree walk): it hits, and
/// changes neither recency, nor order of arrival, nor reference bits, nor dirtiness. A policy that counts uses would need
/// it. The caller drops no line access from its *counts*: [`accesses`](LineChunk::accesses) has them all.
#[derive(Debug)]
pub(super) struct LineChunk {
    /// Kept apart from the tags: reads that hit need no tag.
    slots: Vec<u32>,
    tags: Vec<Tag>,
    len: usize,
    accesses: u64,
    writes: bool,
}

impl LineChunk {
    pub(super) fn new() -> Self {
        Self { slots: Vec::new(), tags: Vec::new(), len: 0, accesses: 0, writes: false }
    }

    /// Replaces the content by line accesses from the front of `rest` and takes them away from it: of all records, unless
    /// some are so long that they would make a chunk without bounds. False if there are none left.
    pub(super) fn split(&mut self, space: &LineSpace, rest: &mut Rest) -> bool {
        (self.len, self.accesses, self.writes) = (0, 0, false);
        // Two places for each record, since the second is written before it is known to be needed.
        self.reserve(2 * rest.records.len() + MAX_LONG);
        let (slots, tags) = (&mut self.slots[..], &mut self.tags[..]);
        // Slot and tag of the line access before; no tag has all bits set.
        let mut before = (0, Tag(u32::MAX));
        let (mut len, mut accesses, mut writes, mut taken) = (0, 0, 0, 0);
        for record in rest.records {
            let tag = Tag::new(record);
            let first = space.slot(record.region, record.address);
            let last = space.slot(record.region, record.address + u64::from(record.len.max(1) - 1));
            writes |= tag.0;
            if last.wrapping_sub(first) > 1 {
                // Longer than a line: as far as it goes within this chunk, which ends here.
                let from = first + rest.lines_taken;
                let to = last.min(from + (MAX_LONG as u32 - 1));
                for slot in from..=to {
                    (slots[len], tags[len]) = (slot, tag);
                    len += 1;
                }
                accesses += u64::from(to - from) + 1;
                rest.lines_taken = if to == last { 0 } else { to - first + 1 };
                taken += usize::from(to == last);
                break;
            }
            // Which of the two to keep depends on the data, so it is arithmetic and not a branch.
            let spans = usize::from(first != last);
            (slots[len], tags[len]) = (first, tag);
            len += usize::from((first, tag) != before);
            (slots[len], tags[len]) = (last, tag);
            len += spans;
            accesses += 1 + spans as u64;
            before = (last, tag);
            taken += 1;
        }
        rest.records = &rest.records[taken..];
        (self.len, self.accesses, self.writes) = (len, accesses, writes & 1 != 0);
        accesses > 0
    }

    fn reserve(&mut self, len: usize) {
        if self.slots.len() < len {
            self.slots.resize(len, 0);
            self.tags.resize(len, Tag(0));
        }
    }

    /// Slots of the line accesses, immediate repeats left out.
    pub(super) fn slots(&self) -> &[u32] {
        &self.slots[..self.len]
    }

    /// Tags of the same line accesses.
    pub(super) fn tags(&self) -> &[Tag] {
        &self.tags[..self.len]
    }

    /// Number of line accesses, immediate repeats included.
    pub(super) fn accesses(&self) -> u64 {
        self.accesses
    }

    /// Whether any of them writes.
    pub(super) fn writes(&self) -> bool {
        self.writes
    }
}

#[cfg(test)]
mod tests {
    use pm_formats::trace::{AccessKind, Coding};

    use super::*;

    fn region(base: u64, size: u64) -> Region {
        Region { name: String::new(), base, size, record_size: 1, coding: Coding::Records }
    }

    fn slots(space: &LineSpace, records: &[(u64, u32)]) -> (Vec<u32>, u64) {
        let kind = AccessKind::Read;
        let record = |&(address, len)| Record { address, len, region: 0, kind };
        let records: Vec<Record> = records.iter().map(record).collect();
        let (mut chunk, mut rest) = (LineChunk::new(), Rest::from(&records[..]));
        let (mut slots, mut accesses) = (Vec::new(), 0);
        while chunk.split(space, &mut rest) {
            slots.extend_from_slice(chunk.slots());
            accesses += chunk.accesses();
        }
        (slots, accesses)
    }

    #[test]
    fn gaps_between_regions_cost_no_slots() {
        let regions = [region(1 << 60, 4096), region(0, 100), region(u64::MAX - 4095, 4096), region(8192, 0)];
        let space = LineSpace::new(&regions, 128);
        assert_eq!(space.slots(), 32 + 1 + 32);
        assert_eq!((space.slot(1, 0), space.slot(0, 1 << 60), space.slot(2, u64::MAX)), (0, 1, 64));
        assert_eq!((space.line(1, 0), space.line(0, 1), space.line(2, 64)), (0, 1 << 53, u64::MAX >> 7));
    }

    #[test]
    fn a_line_shared_by_regions_is_one_slot() {
        let regions = [region(4096, 4096), region(8192, 10), region(12288, 10_000)];
        let space = LineSpace::new(&regions, 16384);
        assert_eq!(space.slots(), 2);
        assert_eq!((space.slot(0, 4096), space.slot(1, 8192), space.slot(2, 16384)), (0, 0, 1));
    }

    #[test]
    fn records_are_split_where_lines_end() {
        let space = LineSpace::new(&[region(0, 1 << 20)], 16);
        assert_eq!(slots(&space, &[(0, 16), (16, 17)]), (vec![0, 1, 2], 3));
        assert_eq!(slots(&space, &[(15, 1), (15, 2)]), (vec![0, 1], 3), "the second begins with a repeat");
        assert_eq!(slots(&space, &[(8, 80), (80, 1), (0, 0)]), (vec![0, 1, 2, 3, 4, 5, 5, 0], 8));
        let (long, accesses) = slots(&space, &[(0, 1 << 20), (0, 4), (8, (1 << 20) - 8)]);
        assert_eq!((long.len(), accesses), ((2 << 16) + 1, (2 << 16) + 1));
        assert!(long[..1 << 16].iter().copied().eq(0..1 << 16) && long[(1 << 16) + 1..].iter().copied().eq(0..1 << 16));
        assert_eq!(slots(&space, &[]), (vec![], 0));
    }
}
