//! A number for each line of the traced memory, without gaps.

use std::sync::Arc;

use pm_formats::trace::Region;

use super::{MAX_LINES, Shape};
use crate::{SimulationError, SpanRule};

/// Numbers the lines of all regions without gaps, so that a model can keep a table indexed by line.
///
/// The number is called a *slot*. Gaps between regions, however wide, have no slots; lines that two regions share (which
/// takes lines longer than the 4 KiB that keep regions apart) have one.
#[derive(Debug)]
pub struct LineSpace {
    /// log2 of the line in bytes.
    pub(super) shift: u32,
    pub(super) regions: Vec<Numbering>,
    slots: u64,
    /// Where lines are numbered by the places of their pages: log2 of the lines of a page, and the pages by place.
    pages: Option<(u32, Arc<Vec<u64>>)>,
    /// Bits of a record's length that count: all, or none if only the line of its first byte is touched.
    pub(super) len_mask: u32,
    /// A record counts once.
    once: bool,
}

/// How the lines of a region are numbered.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Numbering {
    /// First byte address.
    base: u64,
    /// Line number minus slot, modulo 2^64.
    delta: u64,
    /// Bytes of the region.
    size: u64,
}

impl Numbering {
    /// Calls `tell` with the slots of the first and the last line of each record of this length at one of these offsets within the
    /// region, as [`ends`](Self::ends) finds them. Many at a time, in 32 bits where they suffice.
    #[inline]
    pub(super) fn ends_of(self, shift: u32, offsets: &[u64], len: u32, ends: &mut [[u32; 2]]) {
        let in_line = self.base & ((1 << shift) - 1);
        let more = len.max(1) - 1;
        if self.size.saturating_add(in_line).saturating_add(u64::from(more)) > u64::from(u32::MAX) {
            ends.iter_mut().zip(offsets).for_each(|(ends, &offset)| *ends = self.ends(shift, offset, len).into());
            return;
        }
        let (in_line, slot) = (in_line as u32, (self.base >> shift).wrapping_sub(self.delta) as u32);
        for (ends, &offset) in ends.iter_mut().zip(offsets) {
            let first = in_line.wrapping_add(offset as u32);
            *ends = [(first >> shift).wrapping_add(slot), (first.wrapping_add(more) >> shift).wrapping_add(slot)];
        }
    }

    /// Slots of the first and the last line of a record. One of length zero lies in the line of its offset.
    #[inline]
    pub(super) fn ends(self, shift: u32, offset: u64, len: u32) -> (u32, u32) {
        let first = self.base + offset;
        let last = first + u64::from(len.max(1) - 1);
        let slot = |address: u64| (address >> shift).wrapping_sub(self.delta) as u32;
        (slot(first), slot(last))
    }
}

impl LineSpace {
    /// Slots for lines of `line_bytes` (a power of two). No region may reach past the last address.
    pub(crate) fn new(regions: &[Region], line_bytes: u32) -> Self {
        let shift = line_bytes.ilog2();
        let mut by_base: Vec<usize> = (0..regions.len()).filter(|&r| regions[r].size > 0).collect();
        by_base.sort_by_key(|&r| regions[r].base);

        let mut numberings: Vec<Numbering> =
            regions.iter().map(|r| Numbering { base: r.base, delta: 0, size: r.size }).collect();
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
        Self { shift, regions: numberings, slots, pages: None, len_mask: u32::MAX, once: false }
    }

    /// Slots for lines of `line_bytes` in pages of 2^`page_shift` bytes, which have [`Places`](super::Places) in their region,
    /// the only one. A line is no longer than a page.
    pub(crate) fn of_places(line_bytes: u32, page_shift: u32) -> Self {
        let shift = line_bytes.ilog2();
        let pages = Some((page_shift - shift, Arc::default()));
        Self { shift, regions: vec![Numbering::default()], slots: 0, pages, len_mask: u32::MAX, once: false }
    }

    /// Where pages have places: there are these, by place, and the first are as before.
    pub(crate) fn extend(&mut self, pages: &Arc<Vec<u64>>) {
        if let Some((lines, known)) = &mut self.pages {
            self.slots = (pages.len() as u64) << *lines;
            *known = Arc::clone(pages);
        }
    }

    /// Lets go of the pages, so that others are found: until it is told them again, lines have no numbers.
    pub(crate) fn let_go(&mut self) {
        if let Some((_, known)) = &mut self.pages {
            *known = Arc::default();
        }
    }

    /// Whether its slots become more as the trace goes on.
    #[must_use]
    pub fn grows(&self) -> bool {
        self.pages.is_some()
    }

    /// The most slots there may ever be.
    #[must_use]
    pub fn most_slots(&self) -> u64 {
        if self.grows() { MAX_LINES } else { self.slots }
    }

    /// The same with another rule for records that span lines.
    pub(crate) fn with_span(self, span: SpanRule) -> Self {
        Self { len_mask: if span == SpanRule::First { 0 } else { u32::MAX }, once: span == SpanRule::Once, ..self }
    }

    /// Whether a record counts once, however many lines it has.
    pub(crate) fn counts_records(&self) -> bool {
        self.once
    }

    /// Slots of the first and the last line that a record touches.
    #[inline]
    pub(crate) fn ends(&self, offset: u64, shape: Shape) -> (u32, u32) {
        self.regions[shape.attributes().region()].ends(self.shift, offset, shape.len() & self.len_mask)
    }

    /// How many lines a record touches besides that of its first byte.
    #[inline]
    pub(super) fn more_lines(&self, offset: u64, len: u32) -> u32 {
        let in_line = offset & u64::from(self.line_bytes() - 1);
        ((in_line + u64::from((len & self.len_mask).max(1) - 1)) >> self.shift) as u32
    }

    /// Lines of a page that has a place; 1 where there are no such pages.
    pub(crate) fn page_lines(&self) -> u32 {
        self.pages.as_ref().map_or(1, |(lines, _)| 1 << lines)
    }

    /// How many lines from that of `slot` on lie side by side for sure: to the end of its page, where pages have places.
    pub(super) fn rest_of_page(&self, slot: u32) -> u32 {
        self.pages.as_ref().map_or(u32::MAX, |(lines, _)| (1 << lines) - (slot & ((1 << lines) - 1)))
    }

    /// Line in bytes.
    #[must_use]
    pub fn line_bytes(&self) -> u32 {
        1 << self.shift
    }

    /// Whether the lines are few enough.
    pub(crate) fn check(&self) -> Result<(), SimulationError> {
        match self.slots > MAX_LINES {
            true => Err(SimulationError::TooManyLines { lines: self.slots, line_bytes: self.line_bytes() }),
            false => Ok(()),
        }
    }

    /// Number of slots, so far if their number [`grows`](Self::grows).
    #[must_use]
    pub fn slots(&self) -> u64 {
        self.slots
    }

    /// The line number (byte address / line bytes) of a slot that an access to `region` touched.
    #[inline]
    #[must_use]
    pub fn line(&self, region: usize, slot: u32) -> u64 {
        match &self.pages {
            None => u64::from(slot).wrapping_add(self.regions[region].delta),
            Some((lines, pages)) => pages[(slot >> lines) as usize] << lines | u64::from(slot & ((1 << lines) - 1)),
        }
    }
}
