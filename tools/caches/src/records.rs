//! Accesses of the trace that wait to be simulated.

use pm_formats::trace::{Access, AccessKind, Region};

use super::RecordCounts;

/// What an access is besides its bytes: its region and its kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tag(u32);

impl Tag {
    #[inline]
    fn new(region: u16, kind: AccessKind) -> Self {
        Self(u32::from(region) << 2 | kind as u32)
    }

    /// The region accessed.
    #[inline]
    pub(super) fn region(self) -> usize {
        (self.0 >> 2) as usize
    }

    /// Whether the access is a write or a read-modify-write: the line turns dirty.
    #[inline]
    pub(super) fn writes(self) -> bool {
        self.0 & 3 != AccessKind::Read as u32
    }

    fn kind(self) -> AccessKind {
        match self.0 & 3 {
            0 => AccessKind::Read,
            1 => AccessKind::Write,
            _ => AccessKind::ReadModifyWrite,
        }
    }
}

/// An access but for its offset: tag and length. Most batches of most traces have only one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Shape(u64);

impl Shape {
    /// The shape of an access.
    #[inline]
    pub(super) fn new(access: &Access) -> Self {
        Self(u64::from(Tag::new(access.region, access.kind).0) << 32 | u64::from(access.len))
    }

    /// Region and kind.
    #[inline]
    pub(super) fn tag(self) -> Tag {
        Tag((self.0 >> 32) as u32)
    }

    /// Length in bytes.
    #[inline]
    pub(super) fn len(self) -> u32 {
        self.0 as u32
    }
}

/// The most accesses that wait: few enough for them and their line accesses to stay in a core's own cache, enough that
/// most uses are dead when the LRU stack looks back at them.
pub(super) const CHUNK: usize = 2048;

/// Accesses on their way in.
#[derive(Debug)]
pub(super) struct Records {
    // Fixed lengths, so that adding an access is one comparison and two stores.
    offsets: Box<[u64; CHUNK]>,
    shapes: Box<[Shape; CHUNK]>,
    /// Accesses wait at `start..end`.
    start: usize,
    end: usize,
}

/// Accesses to be simulated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Batch<'a> {
    /// Byte offsets from the bases of the regions.
    pub(super) offsets: &'a [u64],
    /// Regions, kinds and lengths.
    pub(super) shapes: &'a [Shape],
    /// The shape that all have, if there is one.
    pub(super) common: Option<Shape>,
}

impl Records {
    /// Room for `capacity` accesses, at most [`CHUNK`].
    pub(super) fn new(capacity: usize) -> Self {
        let start = CHUNK.saturating_sub(capacity);
        Self { offsets: Box::new([0; CHUNK]), shapes: Box::new([Shape::default(); CHUNK]), start, end: start }
    }

    /// Adds an access; false if there is no room.
    #[inline]
    pub(super) fn push(&mut self, access: &Access) -> bool {
        if self.end >= CHUNK {
            return false;
        }
        self.offsets[self.end] = access.offset;
        self.shapes[self.end] = Shape::new(access);
        self.end += 1;
        true
    }

    /// Number of accesses that wait.
    pub(super) fn len(&self) -> usize {
        self.end - self.start
    }

    /// Forgets all accesses.
    pub(super) fn clear(&mut self) {
        self.end = self.start;
    }

    /// The accesses that wait.
    pub(super) fn batch(&self) -> Batch<'_> {
        let shapes = &self.shapes[self.start..self.end];
        let common = shapes.first().copied().filter(|first| {
            let differences = shapes.iter().fold(0, |bits, shape| bits | (shape.0 ^ first.0));
            differences == 0
        });
        Batch { offsets: &self.offsets[self.start..self.end], shapes, common }
    }
}

impl Batch<'_> {
    /// Whether each access lies within its region.
    pub(super) fn are_within(&self, regions: &[Region]) -> bool {
        let limit = |shape: Shape| {
            // The offsets that are within lie below this.
            let size = regions.get(shape.tag().region()).map_or(0, |region| region.size);
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
    pub(super) fn reads(&self) -> impl Iterator<Item = (usize, u64, u32)> {
        let records = self.offsets.iter().zip(self.shapes).filter(|(_, shape)| shape.tag().kind() != AccessKind::Write);
        records.map(|(&offset, shape)| (shape.tag().region(), offset, shape.len()))
    }

    /// Adds the accesses to the counts of their regions.
    pub(super) fn count(&self, counts: &mut [RecordCounts]) {
        let mut add = |shape: Shape, number: u64| {
            let bytes = number * u64::from(shape.len());
            counts[shape.tag().region()].add_records(shape.tag().kind(), number, bytes);
        };
        match self.common {
            Some(shape) => add(shape, self.shapes.len() as u64),
            None => self.shapes.iter().for_each(|&shape| add(shape, 1)),
        }
    }
}

#[cfg(test)]
mod tests {
    use pm_formats::trace::lay_out;

    use super::*;

    #[test]
    fn only_accesses_within_their_regions_are_let_through() {
        let regions =
            lay_out([100, 0, 1 << 40].map(|size| (String::new(), size, 1, pm_formats::trace::Coding::Records)));
        let within = |accesses: &[(u16, u64, u32)]| {
            let mut records = Records::new(CHUNK);
            accesses
                .iter()
                .for_each(|&(region, offset, len)| assert!(records.push(&Access::read(region, offset, len))));
            records.batch().are_within(&regions)
        };
        for good in [(0, 0, 100), (0, 80, 20), (0, 99, 0), (2, (1 << 40) - 4, 4)] {
            assert!(within(&[good]) && within(&[good, good]) && within(&[(0, 0, 1), good]), "{good:?}");
        }
        for bad in
            [(0, 0, 101), (0, 81, 20), (0, 100, 0), (0, 200, 1), (0, u64::MAX, 20), (0, 1 << 63, 1), (0, 0, u32::MAX)]
        {
            assert!(!within(&[bad]) && !within(&[bad, (0, 0, 1)]) && !within(&[(0, 0, bad.2), bad]), "{bad:?}");
        }
        assert!(!within(&[(1, 0, 0)]) && !within(&[(3, 0, 1)]) && within(&[]));
    }
}
