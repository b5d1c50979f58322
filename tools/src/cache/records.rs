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

/// The most accesses that wait: few enough for them and their line accesses to stay in a core's own cache, enough that
/// most uses are dead when the LRU stack looks back at them.
pub(super) const CHUNK: usize = 2048;

/// Accesses side by side: arrays of what is needed together, so that loops over them take several at a step, and of fixed
/// length, so that adding one is three stores.
#[derive(Debug)]
struct Arrays {
    offsets: [u64; CHUNK],
    lens: [u32; CHUNK],
    tags: [Tag; CHUNK],
}

/// Accesses on their way in.
#[derive(Debug)]
pub(super) struct Records {
    arrays: Box<Arrays>,
    len: usize,
    capacity: usize,
}

/// Accesses to be simulated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Batch<'a> {
    /// Byte offsets from the bases of the regions.
    pub(super) offsets: &'a [u64],
    /// Lengths in bytes.
    pub(super) lens: &'a [u32],
    /// Regions and kinds.
    pub(super) tags: &'a [Tag],
    /// The tag that all have, if there is one.
    pub(super) common_tag: Option<Tag>,
}

impl Records {
    /// Room for `capacity` accesses, at most [`CHUNK`].
    pub(super) fn new(capacity: usize) -> Self {
        let arrays = Box::new(Arrays { offsets: [0; CHUNK], lens: [0; CHUNK], tags: [Tag::default(); CHUNK] });
        Self { arrays, len: 0, capacity: capacity.min(CHUNK) }
    }

    /// Whether there is no more room.
    #[inline]
    pub(super) fn is_full(&self) -> bool {
        self.len >= self.capacity
    }

    /// Adds an access.
    #[inline]
    pub(super) fn push(&mut self, access: Access) {
        self.arrays.offsets[self.len] = access.offset;
        self.arrays.lens[self.len] = access.len;
        self.arrays.tags[self.len] = Tag::new(access.region, access.kind);
        self.len += 1;
    }

    /// Forgets all accesses.
    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    /// The accesses that wait.
    pub(super) fn batch(&self) -> Batch<'_> {
        let tags = &self.arrays.tags[..self.len];
        let first = self.arrays.tags[0];
        let differences = tags.iter().fold(0, |bits, tag| bits | (tag.0 ^ first.0));
        Batch {
            offsets: &self.arrays.offsets[..self.len],
            lens: &self.arrays.lens[..self.len],
            tags,
            common_tag: (differences == 0).then_some(first),
        }
    }
}

impl Batch<'_> {
    /// Whether each access lies within its region.
    pub(super) fn are_within(&self, regions: &[Region]) -> bool {
        let accesses = self.offsets.iter().zip(self.lens);
        match self.common_tag {
            // An empty batch may have the tag of a region that is not there.
            _ if self.tags.is_empty() => true,
            Some(tag) if tag.region() < regions.len() && regions[tag.region()].size >> 63 == 0 => {
                // Nothing here has its top bit set, unless an offset or an end is too large: then so is one of these.
                let size = regions[tag.region()].size;
                let bits = accesses.fold(0, |bits, (&offset, &len)| {
                    let end = offset.wrapping_add(u64::from(len.max(1)));
                    bits | offset | end | size.wrapping_sub(end)
                });
                bits >> 63 == 0
            }
            _ => accesses.zip(self.tags).all(|((&offset, &len), tag)| {
                let size = regions.get(tag.region()).map_or(0, |region| region.size);
                offset < size && u64::from(len) <= size - offset
            }),
        }
    }

    /// Adds the accesses to the counts of their regions.
    pub(super) fn count(&self, counts: &mut [RecordCounts]) {
        match self.common_tag {
            _ if self.tags.is_empty() => {}
            Some(tag) => {
                let bytes = self.lens.iter().map(|&len| u64::from(len)).sum();
                counts[tag.region()].add_records(tag.kind(), self.tags.len() as u64, bytes);
            }
            None => {
                for (&len, tag) in self.lens.iter().zip(self.tags) {
                    counts[tag.region()].add_records(tag.kind(), 1, len.into());
                }
            }
        }
    }
}
