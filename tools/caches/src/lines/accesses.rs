//! Accesses of the trace that wait to be simulated.

use pm_formats::trace::{Access, AccessKind, Region};

use super::Shape;
use crate::RecordCounts;

/// The most accesses that wait: few enough for them and their line accesses to stay in a core's own cache, enough that
/// most uses are dead when the LRU stack looks back at them.
pub(crate) const CHUNK: usize = 2048;

/// Accesses on their way in.
#[derive(Debug)]
pub(crate) struct AccessBuffer {
    // Fixed lengths, so that adding an access is one comparison and two stores.
    offsets: Box<[u64; CHUNK]>,
    shapes: Box<[Shape; CHUNK]>,
    /// Accesses wait at `start..end`.
    start: usize,
    end: usize,
}

/// Accesses to be simulated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Accesses<'a> {
    /// Byte offsets from the bases of the regions.
    pub(crate) offsets: &'a [u64],
    /// The same of the last bytes where these do not follow from the first, since pages have [`Places`](super::Places).
    pub(crate) lasts: Option<&'a [u64]>,
    /// Whether each is a further piece of the one before, if any is.
    pub(crate) further: Option<&'a [bool]>,
    /// Regions, kinds and lengths.
    pub(crate) shapes: &'a [Shape],
    /// The shape that all have, if there is one.
    pub(crate) common: Option<Shape>,
}

impl AccessBuffer {
    /// Room for `capacity` accesses, at most [`CHUNK`].
    pub(crate) fn new(capacity: usize) -> Self {
        let start = CHUNK.saturating_sub(capacity);
        Self { offsets: Box::new([0; CHUNK]), shapes: Box::new([Shape::default(); CHUNK]), start, end: start }
    }

    /// Adds an access; false if there is no room.
    #[inline]
    pub(crate) fn push(&mut self, access: &Access) -> bool {
        if self.end >= CHUNK {
            return false;
        }
        self.offsets[self.end] = access.offset;
        self.shapes[self.end] = Shape::new(access);
        self.end += 1;
        true
    }

    /// Adds as many of these as there is room for, and says how many that is.
    pub(crate) fn push_all(&mut self, accesses: &[Access]) -> usize {
        let number = accesses.len().min(CHUNK - self.end);
        let places = self.end..self.end + number;
        let room = self.offsets[places.clone()].iter_mut().zip(&mut self.shapes[places]);
        for ((offset, shape), access) in room.zip(accesses) {
            (*offset, *shape) = (access.offset, Shape::new(access));
        }
        self.end += number;
        number
    }

    /// Adds as many of the reads of these records as there is room for, and says how many that is.
    pub(crate) fn push_records(&mut self, region: u16, size: u32, records: &[u32]) -> usize {
        let number = records.len().min(CHUNK - self.end);
        let places = self.end..self.end + number;
        for (offset, &record) in self.offsets[places.clone()].iter_mut().zip(records) {
            *offset = u64::from(record) * u64::from(size);
        }
        self.shapes[places].fill(Shape::new(&Access::read(region, 0, size)));
        self.end += number;
        number
    }

    /// Whether there is no room for another.
    pub(crate) fn is_full(&self) -> bool {
        self.end >= CHUNK
    }

    /// Number of accesses that wait.
    pub(crate) fn len(&self) -> usize {
        self.end - self.start
    }

    /// Forgets all accesses.
    pub(crate) fn clear(&mut self) {
        self.end = self.start;
    }

    /// The accesses that wait.
    pub(crate) fn waiting(&self) -> Accesses<'_> {
        let shapes = &self.shapes[self.start..self.end];
        let common = shapes.first().copied().filter(|first| {
            let differences = shapes.iter().fold(0, |bits, shape| bits | shape.difference(*first));
            differences == 0
        });
        Accesses { offsets: &self.offsets[self.start..self.end], lasts: None, further: None, shapes, common }
    }
}

impl Accesses<'_> {
    /// Whether the access at an index is a further piece of the one before.
    pub(crate) fn goes_on(&self, at: usize) -> bool {
        self.further.is_some_and(|further| further[at])
    }

    /// Whether each access lies within its region.
    pub(crate) fn are_within(&self, regions: &[Region]) -> bool {
        let limit = |shape: Shape| {
            // The offsets that are within lie below this.
            let size = regions.get(shape.attributes().region()).map_or(0, |region| region.size);
            size.saturating_add(1).saturating_sub(u64::from(shape.len().max(1)))
        };
        match self.common.map(limit) {
            Some(limit) if limit >> 63 == 0 => {
                // One of these has its top bit set if an offset is not below the limit, none if all are.
                let bits = self.offsets.iter().fold(!0, |bits, offset| bits & !offset & offset.wrapping_sub(limit));
                bits >> 63 == 1 || self.offsets.is_empty()
            }
            _ => self.offsets.iter().zip(self.shapes).all(|(&offset, &shape)| offset < limit(shape)),
        }
    }

    /// Region, offset and length of each access that reads.
    pub(crate) fn reads(&self) -> impl Iterator<Item = (usize, u64, u32)> {
        let records =
            self.offsets.iter().zip(self.shapes).filter(|(_, shape)| shape.attributes().kind() != AccessKind::Write);
        records.map(|(&offset, shape)| (shape.attributes().region(), offset, shape.len()))
    }

    /// Adds the accesses to the counts of their regions.
    pub(crate) fn count(&self, counts: &mut [RecordCounts]) {
        let mut add = |shape: Shape, number: u64| {
            let bytes = number * u64::from(shape.len());
            counts[shape.attributes().region()].add_records(shape.attributes().kind(), number, bytes);
        };
        match self.common {
            Some(shape) => add(shape, self.shapes.len() as u64),
            None => self.shapes.iter().for_each(|&shape| add(shape, 1)),
        }
    }
}
