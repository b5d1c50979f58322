//! The line accesses of a stretch of the trace: records are cut where lines end.

use std::ops::Range;

use super::changes::{SLACK, pack_changes};
use super::{Accesses, Attributes, LineSpace, Shape, Shapes};

/// Where a search begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SearchStart {
    /// Index of its first access.
    pub(crate) at: usize,
    /// The batch it belongs to.
    pub(crate) batch: u64,
}

/// Which records are already cut into line accesses, and which searches have begun.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Resume {
    records: usize,
    /// Lines of the next record.
    lines: u32,
    searches: usize,
}

/// How many line accesses there are in a chunk, roughly, before a record that spans many lines has to wait or is cut.
const LONG_CHUNK: usize = 16384;

/// Whether a chunk holds line accesses that repeat the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Repeats {
    /// All of them: some model of the line size needs them.
    Kept,
    /// None within a stretch of records that waited together.
    #[default]
    LeftOut,
}

/// The line accesses of a stretch of the trace.
///
/// A line access *repeats* the one before if both are to the same line, for the same region, and of the same kind (one in
/// seven in a tree walk). It hits, and changes neither recency, nor order of arrival, nor reference bits, nor dirtiness; so
/// it is left out, unless a model of the line size says that [it matters](crate::CacheModel::repeats_matter). Where a
/// stretch begins, or a search of which somebody wants to know, a repeat may be there all the same: models to which repeats do not matter count alike with and without
/// them. It is left out of no *count*: [`accesses`](LineChunk::accesses) has them all.
#[derive(Debug, Default)]
pub struct LineChunk {
    repeats: Repeats,
    /// Whether somebody wants to know which line access belongs to which record.
    numbered: bool,
    slots: Vec<u32>,
    /// The attributes of each slot, or those that all have.
    attributes: Vec<Attributes>,
    /// Picks the attributes of a slot: all bits set, or none if all have the same. Most chunks of most traces read one
    /// region.
    attribute_mask: usize,
    len: usize,
    /// First and last slot of each record, where all are found before any is taken.
    ends: Vec<[u32; 2]>,
    /// Where searches begin among the line accesses.
    starts: Vec<SearchStart>,
    accesses: u64,
    writes: bool,
    /// Where records count once, or somebody wants to know: number of the record of each line access, from 1 on over the
    /// whole trace.
    records: Vec<u64>,
    /// The record begun last.
    record: u64,
}

/// Not a slot: there are fewer (`MAX_LINES` of the simulation).
const NO_SLOT: u32 = u32::MAX;

impl LineChunk {
    /// An empty one.
    pub(crate) fn new(repeats: Repeats) -> Self {
        Self { repeats, ..Self::default() }
    }

    /// The same, and knows which line access belongs to which record, in a trace of regions laid out beforehand.
    pub(crate) fn numbered(self, numbered: bool) -> Self {
        Self { numbered, ..self }
    }

    /// The number of the record begun last.
    pub(crate) fn last_record(&self) -> u64 {
        self.record
    }

    /// Replaces the content by the line accesses of `accesses` from `resume` on, and moves that on: past all records unless
    /// some are so long that they would make a chunk without bounds. Searches that somebody wants to know of begin at `starts`.
    /// False if neither records nor searches are left.
    pub(crate) fn split(
        &mut self,
        space: &LineSpace,
        accesses: &Accesses,
        starts: &[SearchStart],
        resume: &mut Resume,
    ) -> bool {
        if resume.records == accesses.len() && resume.searches == starts.len() {
            return false;
        }
        self.starts.clear();
        if space.counts_records() || self.numbered {
            // Which line access belongs to which record is known there.
            self.writes = accesses.shapes.write();
            self.split_long(space, accesses, starts, resume);
            return true;
        }
        self.writes = accesses.shapes.write();
        let short = match accesses.shapes {
            Shapes::Alike(shape) => {
                self.attributes.clear();
                self.attributes.push(shape.attributes());
                self.attribute_mask = 0;
                self.pack_alike(space, accesses, starts, shape)
            }
            Shapes::Each(shapes) => {
                let least = 2 * shapes.len();
                self.attributes.resize(self.attributes.len().max(least), Attributes::default());
                self.attribute_mask = usize::MAX;
                match (self.repeats, accesses.lasts) {
                    (Repeats::LeftOut, None) => self.pack::<false, false>(space, accesses, starts, shapes),
                    (Repeats::Kept, None) => self.pack::<true, false>(space, accesses, starts, shapes),
                    (Repeats::LeftOut, Some(_)) => self.pack::<false, true>(space, accesses, starts, shapes),
                    (Repeats::Kept, Some(_)) => self.pack::<true, true>(space, accesses, starts, shapes),
                }
            }
        };
        if short {
            *resume = Resume { records: accesses.len(), lines: 0, searches: starts.len() };
        } else {
            self.starts.clear();
            self.split_long(space, accesses, starts, resume);
        }
        true
    }

    /// The line accesses of records of several shapes, repeats among them if they are `KEPT`, and whose last bytes lie elsewhere than
    /// the first if they are `PLACED`; false if one spans more than two lines.
    fn pack<const KEPT: bool, const PLACED: bool>(
        &mut self,
        space: &LineSpace,
        accesses: &Accesses,
        starts: &[SearchStart],
        shapes: &[Shape],
    ) -> bool {
        let records = shapes.len();
        self.slots.resize(self.slots.len().max(2 * records), 0);
        let slots = &mut self.slots[..2 * records];
        let of_slots = &mut self.attributes[..];
        let (mut len, mut before, mut extra, mut most) = (0, (NO_SLOT, Attributes::default()), 0, 0);
        let lasts = accesses.lasts.unwrap_or(accesses.offsets);
        for (start, search) in searches(starts, records) {
            if let Some(start) = start {
                self.starts.push(SearchStart { at: len, ..start });
                before.0 = NO_SLOT;
            }
            let of_search = accesses.offsets[search.clone()].iter().zip(&lasts[search.clone()]).zip(&shapes[search]);
            for ((&offset, &last), &shape) in of_search {
                let attributes = shape.attributes();
                let (first, last, more) = if PLACED {
                    let (first, last) = ((offset >> space.shift) as u32, (last >> space.shift) as u32);
                    (first, last, space.more_lines(offset, shape.len()))
                } else {
                    let (first, last) =
                        space.regions[attributes.region()].ends(space.shift, offset, shape.len() & space.len_mask);
                    (first, last, last - first)
                };
                // Which line accesses there are depends on the data, so it is arithmetic and not a branch: each is written
                // where the next one goes, and the place is taken or not.
                slots[len] = first;
                of_slots[len] = attributes;
                len += usize::from(KEPT || first != before.0 || attributes != before.1);
                slots[len] = last;
                of_slots[len] = attributes;
                len += usize::from(last != first);
                before = (last, attributes);
                extra += u64::from(more);
                most |= more;
            }
        }
        (self.len, self.accesses) = (len, records as u64 + extra);
        most <= 1
    }

    /// The line accesses of records that are all of this shape, repeats among them if they are kept; false if one spans more than two
    /// lines. First all ends are found, side by side, then those are kept that count.
    fn pack_alike(&mut self, space: &LineSpace, accesses: &Accesses, starts: &[SearchStart], shape: Shape) -> bool {
        let records = accesses.offsets.len();
        self.ends.resize(self.ends.len().max(records), [0; 2]);
        let ends = &mut self.ends[..records];
        let (mut spans, mut extra) = (0, 0_u32);
        match accesses.lasts {
            None => {
                let numbering = space.regions[shape.attributes().region()];
                numbering.ends_of(space.shift, accesses.offsets, shape.len() & space.len_mask, ends);
                for [first, last] in &*ends {
                    let more = last.wrapping_sub(*first);
                    spans |= more;
                    extra = extra.wrapping_add(more);
                }
            }
            Some(lasts) => {
                for (ends, (&offset, &last)) in ends.iter_mut().zip(accesses.offsets.iter().zip(lasts)) {
                    *ends = [(offset >> space.shift) as u32, (last >> space.shift) as u32];
                    let more = space.more_lines(offset, shape.len());
                    spans |= more;
                    extra = extra.wrapping_add(more);
                }
            }
        }
        if spans > 1 {
            return false;
        }
        self.slots.resize(self.slots.len().max(2 * records + SLACK), 0);
        self.len = 0;
        for (start, search) in searches(starts, records) {
            self.starts.extend(start.map(|start| SearchStart { at: self.len, ..start }));
            let (ends, slots) = (&ends[search], &mut self.slots[self.len..]);
            self.len += match self.repeats {
                Repeats::LeftOut => pack_changes(ends.as_flattened(), NO_SLOT, slots),
                // Of a record only the second line may be the same as the one before.
                Repeats::Kept => {
                    let slots = &mut slots[..2 * ends.len()];
                    let mut len = 0;
                    for &[first, last] in ends {
                        slots[len] = first;
                        len += 1;
                        slots[len] = last;
                        len += usize::from(last != first);
                    }
                    len
                }
            };
        }
        self.accesses = records as u64 + u64::from(extra);
        true
    }

    /// The line accesses of records of any length, until the chunk is full.
    #[cold]
    fn split_long(&mut self, space: &LineSpace, accesses: &Accesses, starts: &[SearchStart], resume: &mut Resume) {
        self.slots.clear();
        self.attributes.clear();
        self.records.clear();
        self.attribute_mask = usize::MAX;
        let before = self.record;
        while resume.records < accesses.len() && self.slots.len() < LONG_CHUNK {
            let at = resume.records;
            if resume.lines == 0 {
                self.begin_until(at, starts, resume);
            }
            let (shape, attributes) = (accesses.shapes.at(at), accesses.shapes.at(at).attributes());
            let (first, last, more) = match accesses.lasts {
                Some(lasts) => {
                    let slot = |place: u64| (place >> space.shift) as u32;
                    let offset = accesses.offsets[at];
                    (slot(offset), slot(lasts[at]), space.more_lines(offset, shape.len()))
                }
                None => {
                    let (first, last) = space.ends(accesses.offsets[at], shape);
                    (first, last, last - first)
                }
            };
            let from = resume.lines;
            let to = more.min(from + (LONG_CHUNK - self.slots.len()) as u32 - 1);
            // Where the place behind the page is another's, the lines in the page behind lead up to the last.
            let of_page = space.rest_of_page(first);
            self.slots.extend((from..=to).map(|i| if i < of_page { first + i } else { last - (more - i) }));
            self.attributes.resize(self.slots.len(), attributes);
            if space.counts_records() || self.numbered {
                self.record += u64::from(from == 0 && !accesses.goes_on(at));
                self.records.resize(self.slots.len(), self.record);
            }
            *resume = match to == more {
                true => Resume { records: at + 1, lines: 0, ..*resume },
                false => Resume { records: at, lines: to + 1, ..*resume },
            };
        }
        if resume.records == accesses.len() {
            self.begin_until(resume.records, starts, resume);
        }
        self.len = self.slots.len();
        self.accesses = if space.counts_records() { self.record - before } else { self.len as u64 };
    }

    /// Begins the searches that begin with the record of this index or before, where the next line access goes.
    fn begin_until(&mut self, at: usize, starts: &[SearchStart], resume: &mut Resume) {
        for start in starts[resume.searches..].iter().take_while(|start| start.at <= at) {
            self.starts.push(SearchStart { at: self.slots.len(), ..*start });
            resume.searches += 1;
        }
    }

    /// Where the searches begin that somebody wants to know of, as indices of [`slots`](LineChunk::slots).
    pub(crate) fn starts(&self) -> &[SearchStart] {
        &self.starts
    }

    /// Where records are numbered, the number of the record that the line access at an index belongs to.
    pub(crate) fn record(&self, index: usize) -> u64 {
        self.records[index]
    }

    /// Slots of the line accesses.
    #[must_use]
    pub fn slots(&self) -> &[u32] {
        &self.slots[..self.len]
    }

    /// Region and kind of the line access at an index of [`slots`](LineChunk::slots).
    #[inline]
    #[must_use]
    pub fn attributes(&self, index: usize) -> Attributes {
        self.attributes[index & self.attribute_mask]
    }

    /// Number of line accesses, repeats included.
    #[must_use]
    pub fn accesses(&self) -> u64 {
        self.accesses
    }

    /// Whether any of the records writes.
    #[must_use]
    pub fn writes(&self) -> bool {
        self.writes
    }
}

/// So many records, search by search: what is before the first that begins, then each with where it began.
fn searches(starts: &[SearchStart], records: usize) -> impl Iterator<Item = (Option<SearchStart>, Range<usize>)> {
    let begins = std::iter::once(None).chain(starts.iter().copied().map(Some));
    let ends = starts.iter().map(|start| start.at).chain([records]);
    let mut from = 0;
    begins.zip(ends).map(move |(start, end)| (start, std::mem::replace(&mut from, end)..end))
}
