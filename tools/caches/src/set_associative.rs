//! Sets of ways, under any replacement policy of frames.

use super::{
    config::SetIndex,
    lines::{LineChunk, LineSpace},
    misses::Misses,
    model::{CacheModel, Tally},
    replacement::Replacement,
};

/// Sets that lines are spread over.
#[derive(Clone, Copy)]
pub(super) struct Sets {
    /// log2 of their number.
    bits: u32,
    index: SetIndex,
}

impl Sets {
    /// `sets` is a power of two.
    pub(super) fn new(sets: u64, index: SetIndex) -> Self {
        assert!(sets.is_power_of_two());
        Self { bits: sets.ilog2(), index }
    }

    /// How many there are.
    pub(super) fn number(self) -> usize {
        1 << self.bits
    }

    /// The set that a line number belongs to.
    #[inline]
    pub(super) fn of(self, line: u64) -> usize {
        let mut folded = line;
        if self.index == SetIndex::Hash && self.bits > 0 {
            let mut rest = line >> self.bits;
            while rest > 0 {
                folded ^= rest;
                rest >>= self.bits;
            }
        }
        folded as usize & (self.number() - 1)
    }
}

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

/// A cache of sets of ways; one set of all lines is a fully associative cache.
pub(super) struct SetAssociative<R> {
    /// By slot, so that a lookup is one load whatever the number of ways.
    places: Vec<Place>,
    frames: Vec<Frame>,
    /// Frames in use, by set. They fill in order.
    filled: Vec<u32>,
    sets: Sets,
    ways: usize,
    /// Set s owns frames s << stride to (s << stride) + ways - 1; numbers up to the next set's are no frames, so that set
    /// and way of a frame are had without division.
    stride: u32,
    replacement: R,
    tally: Tally,
}

/// The most lines a set-associative cache can have, the ways of a set rounded up to a power of two.
pub(super) const MAX_FRAMES: u64 = u32::MAX as u64 - 1;

/// Numbers of frames that so many sets and ways take up.
pub(super) fn frames_of(sets: u64, ways: u64) -> u64 {
    ways.checked_next_power_of_two().and_then(|ways| sets.checked_mul(ways)).unwrap_or(u64::MAX)
}

impl<R: Replacement> SetAssociative<R> {
    /// `replacement` has the state for the same sets and ways; [`frames_of`] these are at most [`MAX_FRAMES`].
    pub(super) fn new(space: &LineSpace, regions: usize, sets: Sets, ways: usize, replacement: R) -> Self {
        let frames = frames_of(sets.number() as u64, ways as u64);
        assert!(frames <= MAX_FRAMES);
        Self {
            places: vec![Place::NEVER; space.slots() as usize],
            frames: vec![Frame::default(); frames as usize],
            filled: vec![0; sets.number()],
            sets,
            ways,
            stride: ways.next_power_of_two().ilog2(),
            replacement,
            tally: Tally { fetches: vec![0; regions], ..Tally::default() },
        }
    }

    /// Brings `slot` into its set and returns its frame, clean.
    #[inline]
    fn fetch(&mut self, slot: u32, set: usize) -> usize {
        let filled = self.filled[set] as usize;
        let full = filled == self.ways;
        let way = if full { self.replacement.victim(set) } else { filled };
        let frame = (set << self.stride) + way;
        if full {
            self.places[self.frames[frame].slot as usize] = Place::GONE;
        } else {
            self.filled[set] += 1;
        }
        self.frames[frame] = Frame { slot, dirty: false };
        self.places[slot as usize] = Place::in_frame(frame);
        self.replacement.fill(set, way);
        frame
    }
}

impl<R: Replacement> CacheModel for SetAssociative<R> {
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        for (i, &slot) in chunk.slots().iter().enumerate() {
            let tag = chunk.tag(i);
            let place = self.places[slot as usize];
            let frame = if let Some(frame) = place.frame() {
                self.replacement.hit(frame >> self.stride, frame & ((1 << self.stride) - 1));
                frame
            } else {
                misses.push(i, 1);
                let region = tag.region();
                self.tally.fetches[region] += u64::from(counted);
                self.tally.compulsory += u64::from(counted && place == Place::NEVER);
                self.fetch(slot, self.sets.of(space.line(region, slot)))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hashed_index_folds_all_bits_of_the_line() {
        let sets = Sets::new(8, SetIndex::Hash);
        assert_eq!(sets.of(0b101_110_011), 0b101 ^ 0b110 ^ 0b011);
        assert_eq!(sets.of(1 << 63), 1 << (63 % 3));
        // Where it differs from the plain index, and where there is nothing to choose.
        assert_eq!((Sets::new(8, SetIndex::Plain).of(8), sets.of(8)), (0, 1));
        assert_eq!((Sets::new(1, SetIndex::Plain).of(u64::MAX), Sets::new(1, SetIndex::Hash).of(u64::MAX)), (0, 0));
    }

    #[test]
    fn the_hashed_index_spreads_strides_evenly() {
        // As many lines as sets, a power of two apart: each set gets one where the plain index puts all in one.
        for stride in [1, 2, 64, 128, 4096, 1 << 40_u64] {
            let sets = Sets::new(128, SetIndex::Hash);
            let mut met = [0; 128];
            (0..128).for_each(|i| met[sets.of(i * stride)] += 1);
            assert_eq!(met, [1; 128], "stride {stride}");
        }
    }
}
