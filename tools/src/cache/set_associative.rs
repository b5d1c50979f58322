//! Sets of ways, under any replacement policy of frames.

use super::{
    lines::{LineChunk, LineSpace},
    misses::Misses,
    model::{CacheModel, Tally},
    replacement::Replacement,
};

/// Where a line is.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Place(u32);

impl Place {
    /// Not yet touched.
    const NEVER: Self = Self(0);
    /// Touched, evicted since.
    const GONE: Self = Self(1);

    fn in_frame(frame: usize) -> Self {
        Self(frame as u32 + 2)
    }

    #[inline]
    fn frame(self) -> Option<usize> {
        self.0.checked_sub(2).map(|frame| frame as usize)
    }
}

/// What a frame holds.
#[derive(Clone, Copy, Default)]
struct Frame {
    slot: u32,
    dirty: bool,
}

/// A cache of a power of two of sets; a line's set is its line number modulo the sets.
pub(super) struct SetAssociative<R> {
    /// By slot, so that a lookup is one load whatever the number of ways.
    places: Vec<Place>,
    frames: Vec<Frame>,
    /// Frames in use, by set. They fill in order.
    filled: Vec<u32>,
    ways: usize,
    replacement: R,
    tally: Tally,
}

/// The most lines a set-associative cache can have.
pub(super) const MAX_FRAMES: u64 = u32::MAX as u64 - 1;

impl<R: Replacement> SetAssociative<R> {
    /// `sets` is a power of two, and `sets * ways` at most [`MAX_FRAMES`].
    pub(super) fn new(space: &LineSpace, regions: usize, sets: usize, ways: usize) -> Self {
        assert!(sets.is_power_of_two() && ways > 0);
        Self {
            places: vec![Place::NEVER; space.slots() as usize],
            frames: vec![Frame::default(); sets * ways],
            filled: vec![0; sets],
            ways,
            replacement: R::new(sets * ways, ways),
            tally: Tally { fetches: vec![0; regions], ..Tally::default() },
        }
    }

    /// Brings `slot` into its set and returns its frame, clean.
    #[inline]
    fn fetch(&mut self, slot: u32, set: usize) -> usize {
        let first = set * self.ways;
        let filled = self.filled[set] as usize;
        let frame = if filled < self.ways {
            self.filled[set] += 1;
            first + filled
        } else {
            let victim = self.replacement.victim(first);
            self.places[self.frames[victim].slot as usize] = Place::GONE;
            victim
        };
        self.frames[frame] = Frame { slot, dirty: false };
        self.places[slot as usize] = Place::in_frame(frame);
        self.replacement.fill(frame);
        frame
    }
}

impl<R: Replacement> CacheModel for SetAssociative<R> {
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        let sets = self.filled.len() as u64;
        for (i, &slot) in chunk.slots().iter().enumerate() {
            let tag = chunk.tag(i);
            let place = self.places[slot as usize];
            let frame = if let Some(frame) = place.frame() {
                self.replacement.hit(frame);
                frame
            } else {
                misses.push(i, 1);
                let region = tag.region();
                self.tally.fetches[region] += u64::from(counted);
                self.tally.compulsory += u64::from(counted && place == Place::NEVER);
                self.fetch(slot, (space.line(region, slot) & (sets - 1)) as usize)
            };
            if counted && tag.writes() {
                let dirty = std::mem::replace(&mut self.frames[frame].dirty, true);
                self.tally.write_backs += u64::from(!dirty);
            }
        }
    }

    fn finish(self: Box<Self>) -> Vec<Tally> {
        vec![self.tally]
    }
}
