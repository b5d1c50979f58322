//! From byte addresses to lines: the numbering models work with, and the splitting of records that span lines.

use pm_formats::trace::Region;

use super::{
    measures::Span,
    records::{Batch, Shape, Tag},
};

/// Numbers the lines of all regions without gaps, so that a model can keep a table indexed by line.
///
/// The number is called a *slot*. Gaps between regions, however wide, have no slots; lines that two regions share (which
/// takes lines longer than the 4 KiB that keep regions apart) have one.
#[derive(Debug)]
pub(super) struct LineSpace {
    /// log2 of the line in bytes.
    shift: u32,
    regions: Vec<Numbering>,
    slots: u64,
    /// Bits of a record's length that count: all, or none if only the line of its first byte is touched.
    len_mask: u32,
}

/// How the lines of a region are numbered.
#[derive(Clone, Copy, Debug, Default)]
struct Numbering {
    /// First byte address.
    base: u64,
    /// Line number minus slot, modulo 2^64.
    delta: u64,
}

impl Numbering {
    /// Slots of the first and the last line of a record. One of length zero lies in the line of its offset.
    #[inline]
    fn ends(self, shift: u32, offset: u64, len: u32) -> (u32, u32) {
        let first = self.base + offset;
        let last = first + u64::from(len.max(1) - 1);
        let slot = |address: u64| (address >> shift).wrapping_sub(self.delta) as u32;
        (slot(first), slot(last))
    }
}

impl LineSpace {
    /// Slots for lines of `line_bytes` (a power of two). No region may reach past the last address.
    pub(super) fn new(regions: &[Region], line_bytes: u32) -> Self {
        let shift = line_bytes.ilog2();
        let mut by_base: Vec<usize> = (0..regions.len()).filter(|&r| regions[r].size > 0).collect();
        by_base.sort_by_key(|&r| regions[r].base);

        let mut numberings: Vec<Numbering> = regions.iter().map(|r| Numbering { base: r.base, delta: 0 }).collect();
        let (mut slots, mut delta, mut previous) = (0_u64, 0_u64, None);
        for r in by_base {
            let first = regions[r].base >> shift;
            let last = (regions[r].base + (regions[r].size - 1)) >> shift;
            if previous.is_none_or(|p| first > p) {
                delta = first.wrapping_sub(slots);
            }
            // Slots of a shared line, or of a region within another, are already there.
            slots = slots.max(last.wrapping_sub(delta) + 1);
            previous = previous.max(Some(last));
            numberings[r].delta = delta;
        }
        Self { shift, regions: numberings, slots, len_mask: u32::MAX }
    }

    /// The same with another rule for records that span lines.
    pub(super) fn with_span(self, span: Span) -> Self {
        Self { len_mask: if span == Span::Both { u32::MAX } else { 0 }, ..self }
    }

    /// Slots of the first and the last line that a record touches.
    #[inline]
    pub(super) fn ends(&self, offset: u64, shape: Shape) -> (u32, u32) {
        self.regions[shape.tag().region()].ends(self.shift, offset, shape.len() & self.len_mask)
    }

    /// Line in bytes.
    pub(super) fn line_bytes(&self) -> u32 {
        1 << self.shift
    }

    /// Number of slots.
    pub(super) fn slots(&self) -> u64 {
        self.slots
    }

    /// The line number (byte address / line bytes) of a slot that an access to `region` touched.
    #[inline]
    pub(super) fn line(&self, region: usize, slot: u32) -> u64 {
        u64::from(slot).wrapping_add(self.regions[region].delta)
    }
}

/// Which records are already split into line accesses.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cursor {
    records: usize,
    /// Lines of the next record.
    lines: u32,
}

/// How many line accesses there are in a chunk, roughly, before a record that spans many lines has to wait or is cut.
const LONG_CHUNK: usize = 16384;

/// The line accesses of a stretch of the trace.
///
/// A line access that repeats the one before in every respect is left out (one in seven in a tree walk): it hits, and
/// changes neither recency, nor order of arrival, nor reference bits, nor dirtiness. A policy that counts uses would need
/// it. It is left out of no *count*: [`accesses`](LineChunk::accesses) has them all.
#[derive(Debug, Default)]
pub(super) struct LineChunk {
    slots: Vec<u32>,
    /// The tag of each slot, or one tag for all.
    tags: Vec<Tag>,
    /// Picks the tag of a slot: all bits set, or none if one tag is for all. Most chunks of most traces read one region.
    tag_mask: usize,
    len: usize,
    accesses: u64,
    writes: bool,
}

/// Not a slot: there are fewer (`MAX_LINES` of the simulation).
const NO_SLOT: u32 = u32::MAX;

impl LineChunk {
    /// Replaces the content by the line accesses of `batch` from `cursor` on, and moves that on: past all records unless
    /// some are so long that they would make a chunk without bounds. False if no records are left.
    pub(super) fn split(&mut self, space: &LineSpace, batch: &Batch, cursor: &mut Cursor) -> bool {
        if cursor.records == batch.shapes.len() {
            return false;
        }
        let short = match batch.common {
            Some(shape) => {
                self.writes = shape.tag().writes();
                self.tags.clear();
                self.tags.push(shape.tag());
                self.tag_mask = 0;
                self.pack::<false>(space, batch, shape)
            }
            None => {
                self.writes = batch.shapes.iter().fold(false, |any, shape| any | shape.tag().writes());
                self.tags.resize(self.tags.len().max(2 * batch.shapes.len()), Tag::default());
                self.tag_mask = usize::MAX;
                self.pack::<true>(space, batch, Shape::default())
            }
        };
        if short {
            cursor.records = batch.shapes.len();
        } else {
            self.split_long(space, batch, cursor);
        }
        true
    }

    /// The line accesses of all records, whose shapes are `MIXED` or all `common`; false if one spans more than two lines.
    fn pack<const MIXED: bool>(&mut self, space: &LineSpace, batch: &Batch, common: Shape) -> bool {
        let records = batch.shapes.len();
        self.slots.resize(self.slots.len().max(2 * records), 0);
        let slots = &mut self.slots[..2 * records];
        let tags = &mut self.tags[..];
        let numbering = if MIXED { Numbering::default() } else { space.regions[common.tag().region()] };
        let (mut len, mut before, mut extra, mut most) = (0, (NO_SLOT, common.tag()), 0, 0);
        for (&offset, &shape) in batch.offsets.iter().zip(batch.shapes) {
            let shape = if MIXED { shape } else { common };
            let tag = shape.tag();
            let numbering = if MIXED { space.regions[tag.region()] } else { numbering };
            let (first, last) = numbering.ends(space.shift, offset, shape.len() & space.len_mask);
            // Which line accesses there are depends on the data, so it is arithmetic and not a branch: each is written
            // where the next one goes, and the place is taken or not.
            slots[len] = first;
            if MIXED {
                tags[len] = tag;
            }
            len += usize::from(first != before.0 || (MIXED && tag != before.1));
            slots[len] = last;
            if MIXED {
                tags[len] = tag;
            }
            len += usize::from(last != first);
            before = (last, tag);
            extra += u64::from(last - first);
            most |= last - first;
        }
        (self.len, self.accesses) = (len, records as u64 + extra);
        most <= 1
    }

    /// The line accesses of records of any length, until the chunk is full.
    #[cold]
    fn split_long(&mut self, space: &LineSpace, batch: &Batch, cursor: &mut Cursor) {
        self.slots.clear();
        self.tags.clear();
        self.tag_mask = usize::MAX;
        while cursor.records < batch.shapes.len() && self.slots.len() < LONG_CHUNK {
            let at = cursor.records;
            let (shape, tag) = (batch.shapes[at], batch.shapes[at].tag());
            let (first, last) = space.ends(batch.offsets[at], shape);
            let from = first + cursor.lines;
            let to = last.min(from + (LONG_CHUNK - self.slots.len()) as u32 - 1);
            self.slots.extend(from..=to);
            self.tags.resize(self.slots.len(), tag);
            *cursor = match to == last {
                true => Cursor { records: at + 1, lines: 0 },
                false => Cursor { records: at, lines: to - first + 1 },
            };
        }
        self.len = self.slots.len();
        self.accesses = self.len as u64;
    }

    /// Slots of the line accesses, immediate repeats left out.
    pub(super) fn slots(&self) -> &[u32] {
        &self.slots[..self.len]
    }

    /// The tag of the line access at an index of [`slots`](LineChunk::slots).
    #[inline]
    pub(super) fn tag(&self, index: usize) -> Tag {
        self.tags[index & self.tag_mask]
    }

    /// Number of line accesses, immediate repeats included.
    pub(super) fn accesses(&self) -> u64 {
        self.accesses
    }

    /// Whether any of the records writes.
    pub(super) fn writes(&self) -> bool {
        self.writes
    }
}

#[cfg(test)]
mod tests {
    use pm_formats::trace::{Access, AccessKind, Coding};

    use super::{
        super::records::{CHUNK, Records},
        *,
    };

    fn region(base: u64, size: u64) -> Region {
        Region { name: String::new(), base, size, record_size: 1, coding: Coding::Records }
    }

    /// Slots, each with whether it is written, and the number of line accesses.
    fn split(space: &LineSpace, accesses: &[(u64, u32, AccessKind)]) -> (Vec<(u32, bool)>, u64) {
        let mut records = Records::new(CHUNK);
        for &(offset, len, kind) in accesses {
            assert!(records.push(&Access { kind, region: 0, len, offset }));
        }
        let (mut chunk, mut cursor) = (LineChunk::default(), Cursor::default());
        let (mut slots, mut number) = (Vec::new(), 0);
        while chunk.split(space, &records.batch(), &mut cursor) {
            slots.extend(chunk.slots().iter().enumerate().map(|(i, &slot)| (slot, chunk.tag(i).writes())));
            number += chunk.accesses();
        }
        (slots, number)
    }

    fn reads(space: &LineSpace, accesses: &[(u64, u32)]) -> (Vec<u32>, u64) {
        let accesses: Vec<_> = accesses.iter().map(|&(offset, len)| (offset, len, AccessKind::Read)).collect();
        let (slots, number) = split(space, &accesses);
        (slots.into_iter().map(|(slot, _)| slot).collect(), number)
    }

    #[test]
    fn gaps_between_regions_cost_no_slots() {
        let regions = [region(1 << 60, 4096), region(0, 100), region(u64::MAX - 4095, 4096), region(8192, 0)];
        let space = LineSpace::new(&regions, 128);
        assert_eq!(space.slots(), 32 + 1 + 32);
        let ends = |r: usize, offset, len| space.regions[r].ends(7, offset, len);
        assert_eq!((ends(1, 0, 100), ends(0, 0, 4096), ends(2, 4095, 1)), ((0, 0), (1, 32), (64, 64)));
        assert_eq!((space.line(1, 0), space.line(0, 1), space.line(2, 64)), (0, 1 << 53, u64::MAX >> 7));
    }

    #[test]
    fn a_line_shared_by_regions_is_one_slot() {
        let regions = [region(4096, 4096), region(8192, 10), region(12288, 10_000)];
        let space = LineSpace::new(&regions, 16384);
        assert_eq!(space.slots(), 2);
        let ends = |r: usize, offset, len| space.regions[r].ends(14, offset, len);
        assert_eq!((ends(0, 0, 1), ends(1, 9, 1), ends(2, 0, 10_000)), ((0, 0), (0, 0), (0, 1)));
    }

    #[test]
    fn records_are_split_where_lines_end() {
        let space = LineSpace::new(&[region(0, 1 << 20)], 16);
        assert_eq!(reads(&space, &[(0, 16), (16, 16), (31, 1)]), (vec![0, 1], 3), "the last repeats the one before");
        assert_eq!(reads(&space, &[(0, 16), (16, 17)]), (vec![0, 1, 2], 3));
        assert_eq!(reads(&space, &[(15, 1), (15, 2)]), (vec![0, 1], 3), "the second begins with a repeat");
        assert_eq!(reads(&space, &[(8, 80), (81, 1), (0, 0)]), (vec![0, 1, 2, 3, 4, 5, 5, 0], 8));
        assert_eq!(reads(&space, &[]), (vec![], 0));
    }

    #[test]
    fn a_read_and_a_write_are_no_repeats_of_one_another() {
        let space = LineSpace::new(&[region(0, 1 << 20)], 16);
        let (read, write) = ((0, 4, AccessKind::Read), (4, 4, AccessKind::Write));
        let expected = vec![(0, false), (0, true), (0, false)];
        assert_eq!(split(&space, &[read, read, write, write, read]), (expected, 5));
    }

    #[test]
    fn records_of_any_length_come_in_chunks_of_bounded_length() {
        let space = LineSpace::new(&[region(0, 1 << 20)], 16);
        let (slots, accesses) = reads(&space, &[(0, 1 << 20), (0, 4), (8, (1 << 20) - 8)]);
        assert_eq!(accesses, (2 << 16) + 1);
        assert!(slots.into_iter().eq((0..1 << 16).chain([0]).chain(0..1 << 16)));
    }
}
