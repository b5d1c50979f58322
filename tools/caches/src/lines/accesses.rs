//! Accesses of the trace that wait to be simulated.

use pm_formats::trace::{Access, AccessKind, Region};

use super::{Shape, Shapes};
use crate::RecordCounts;

/// The most accesses that wait: few enough for them and their line accesses to stay in a core's own cache, enough that
/// most uses are dead when the LRU stack looks back at them.
pub(crate) const CHUNK: usize = 2048;

/// Accesses on their way in.
#[derive(Debug)]
pub(crate) struct AccessBuffer {
    // Fixed lengths, so that adding an access is few comparisons and a store or two.
    offsets: Box<[u64; CHUNK]>,
    /// Those of all that wait, unless all have the same.
    shapes: Box<[Shape; CHUNK]>,
    /// The shape that all have that wait, if there is one.
    common: Option<Shape>,
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
    pub(crate) shapes: Shapes<'a>,
}

impl AccessBuffer {
    /// Room for `capacity` accesses, at most [`CHUNK`].
    pub(crate) fn new(capacity: usize) -> Self {
        let start = CHUNK.saturating_sub(capacity);
        let (offsets, shapes) = (Box::new([0; CHUNK]), Box::new([Shape::default(); CHUNK]));
        Self { offsets, shapes, common: None, start, end: start }
    }

    /// Adds an access; false if there is no room.
    #[inline]
    pub(crate) fn push(&mut self, access: &Access) -> bool {
        if self.end >= CHUNK {
            return false;
        }
        let shape = Shape::new(access);
        if !self.is_common(shape) {
            self.shapes[self.end] = shape;
        }
        self.offsets[self.end] = access.offset;
        self.end += 1;
        true
    }

    /// Whether an access of this shape that comes next has the one that all have. If not, each has its own from now on.
    #[inline]
    fn is_common(&mut self, shape: Shape) -> bool {
        if self.end == self.start {
            self.common = Some(shape);
        } else if self.common.is_some_and(|common| common != shape) {
            self.part();
        }
        self.common.is_some()
    }

    /// Gives each its own shape.
    #[cold]
    fn part(&mut self) {
        if let Some(common) = self.common.take() {
            self.shapes[self.start..self.end].fill(common);
        }
    }

    /// Adds as many of these as there is room for, and says how many that is.
    pub(crate) fn push_all(&mut self, accesses: &[Access]) -> usize {
        let number = accesses.len().min(CHUNK - self.end);
        let places = self.end..self.end + number;
        let Some(first) = accesses.first().map(Shape::new) else { return 0 };
        // Arithmetic and no branch: that all have the same is what is expected.
        let mut alike = true;
        for (offset, access) in self.offsets[places.clone()].iter_mut().zip(accesses) {
            *offset = access.offset;
            alike &= Shape::new(access) == first;
        }
        if !self.is_common(first) || !alike {
            self.part();
            self.shapes[places].iter_mut().zip(accesses).for_each(|(shape, access)| *shape = Shape::new(access));
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
        let shape = Shape::new(&Access::read(region, 0, size));
        if number > 0 && !self.is_common(shape) {
            self.shapes[places].fill(shape);
        }
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
        let places = self.start..self.end;
        let shapes = self.common.map_or_else(|| Shapes::Each(&self.shapes[places.clone()]), Shapes::Alike);
        Accesses { offsets: &self.offsets[places], lasts: None, further: None, shapes }
    }
}

impl Accesses<'_> {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.offsets.len()
    }

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
        match self.shapes {
            Shapes::Alike(shape) if limit(shape) >> 63 == 0 => {
                let limit = limit(shape);
                // One of these has its top bit set if an offset is not below the limit, none if all are.
                let bits = self.offsets.iter().fold(!0, |bits, offset| bits & !offset & offset.wrapping_sub(limit));
                bits >> 63 == 1 || self.offsets.is_empty()
            }
            shapes => (0..).zip(self.offsets).all(|(i, &offset)| offset < limit(shapes.at(i))),
        }
    }

    /// Region, offset and length of each access that reads.
    pub(crate) fn reads(&self) -> impl Iterator<Item = (usize, u64, u32)> {
        let records = (0..).zip(self.offsets).map(|(i, &offset)| (offset, self.shapes.at(i)));
        let reads = records.filter(|(_, shape)| shape.attributes().kind() != AccessKind::Write);
        reads.map(|(offset, shape)| (shape.attributes().region(), offset, shape.len()))
    }

    /// Adds the accesses to the counts of their regions.
    pub(crate) fn count(&self, counts: &mut [RecordCounts]) {
        let mut add = |shape: Shape, number: u64| {
            let bytes = number * u64::from(shape.len());
            counts[shape.attributes().region()].add_records(shape.attributes().kind(), number, bytes);
        };
        match self.shapes {
            Shapes::Alike(shape) => add(shape, self.len() as u64),
            Shapes::Each(shapes) => shapes.iter().for_each(|&shape| add(shape, 1)),
        }
    }
}
