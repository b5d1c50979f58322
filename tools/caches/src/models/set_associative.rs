//! Sets of ways, under any replacement policy of frames.

use super::{CacheModel, LineCounts, Replacement, Sets};
use crate::{
    lines::{LineChunk, LineSpace, grow},
    misses::Misses,
};

/// What the table says of a line: where it is.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Lookup(u32);

impl Lookup {
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
    /// The region it was last written in, if it is dirty.
    region: u16,
    dirty: bool,
}

/// A cache of sets of ways; one set of all lines is a fully associative cache.
pub(crate) struct SetAssociative<R> {
    /// By slot, so that a lookup is one load whatever the number of ways.
    places: Vec<Lookup>,
    frames: Vec<Frame>,
    /// Frames in use, by set. They fill in order.
    filled: Vec<u32>,
    sets: Sets,
    ways: usize,
    /// Set s owns frames s << stride to (s << stride) + ways - 1; numbers up to the next set's are no frames, so that set
    /// and way of a frame are had without division.
    stride: u32,
    replacement: R,
    counts: LineCounts,
}

/// The most lines a set-associative cache can have, the ways of a set rounded up to a power of two.
pub(crate) const MAX_FRAMES: u64 = u32::MAX as u64 - 1;

/// Numbers of frames that so many sets and ways take up.
pub(super) fn frames_of(sets: u64, ways: u64) -> u64 {
    ways.checked_next_power_of_two().and_then(|ways| sets.checked_mul(ways)).unwrap_or(u64::MAX)
}

impl<R: Replacement> SetAssociative<R> {
    /// `replacement` has the state for the same sets and ways; [`frames_of`] these are at most [`MAX_FRAMES`].
    pub(crate) fn new(space: &LineSpace, regions: usize, sets: Sets, ways: usize, replacement: R) -> Self {
        let frames = frames_of(sets.number() as u64, ways as u64);
        assert!(frames <= MAX_FRAMES);
        Self {
            places: vec![Lookup::NEVER; space.slots() as usize],
            // A single set takes frames as they are filled: it may have room for more lines than ever come.
            frames: vec![Frame::default(); if sets.number() == 1 { 0 } else { frames as usize }],
            filled: vec![0; sets.number()],
            sets,
            ways,
            stride: ways.next_power_of_two().ilog2(),
            replacement,
            counts: LineCounts::new(regions),
        }
    }

    /// Brings `slot` into its set and returns its frame, clean, and what was in it.
    #[inline]
    fn fetch(&mut self, slot: u32, set: usize) -> (usize, Frame) {
        let filled = self.filled[set] as usize;
        let full = filled == self.ways;
        let way = if full { self.replacement.victim(set) } else { filled };
        let frame = (set << self.stride) + way;
        if full {
            self.places[self.frames[frame].slot as usize] = Lookup::GONE;
        } else {
            self.filled[set] += 1;
            if frame == self.frames.len() {
                self.frames.push(Frame::default());
            }
        }
        let before = std::mem::replace(&mut self.frames[frame], Frame { slot, ..Frame::default() });
        self.places[slot as usize] = Lookup::in_frame(frame);
        self.replacement.fill(set, way);
        (frame, before)
    }
}

impl<R: Replacement> CacheModel for SetAssociative<R> {
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        grow(&mut self.places, space, Lookup::NEVER);
        for (i, &slot) in chunk.slots().iter().enumerate() {
            let attributes = chunk.attributes(i);
            let before = self.places[slot as usize];
            let frame = if let Some(frame) = before.frame() {
                self.replacement.hit(frame >> self.stride, frame & ((1 << self.stride) - 1));
                frame
            } else {
                misses.push(i, 1);
                let region = attributes.region();
                self.counts.fetches[region] += u64::from(counted);
                self.counts.compulsory += u64::from(counted && before == Lookup::NEVER);
                let (frame, before) = self.fetch(slot, self.sets.of(space.line(region, slot)));
                if before.dirty {
                    misses.write_back(i, before.region.into(), before.slot);
                }
                frame
            };
            if counted && attributes.writes() {
                let frame = &mut self.frames[frame];
                frame.region = attributes.region() as u16;
                self.counts.write_backs += u64::from(!std::mem::replace(&mut frame.dirty, true));
            }
        }
    }

    fn finish(self: Box<Self>) -> Vec<LineCounts> {
        vec![self.counts]
    }

    fn tells_write_backs(&self) -> bool {
        true
    }

    fn repeats_matter(&self) -> bool {
        R::REPEATS_MATTER
    }
}
