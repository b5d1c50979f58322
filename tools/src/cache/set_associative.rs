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
    replacement: R,
    tally: Tally,
}

/// The most lines a set-associative cache can have.
pub(super) const MAX_FRAMES: u64 = u32::MAX as u64 - 1;

impl<R: Replacement> SetAssociative<R> {
    /// `replacement` has the state for the same sets and ways; these make at most [`MAX_FRAMES`] frames.
    pub(super) fn new(space: &LineSpace, regions: usize, sets: Sets, ways: usize, replacement: R) -> Self {
        let frames = sets.number() * ways;
        assert!(frames > 0 && frames as u64 <= MAX_FRAMES);
        Self {
            places: vec![Place::NEVER; space.slots() as usize],
            frames: vec![Frame::default(); frames],
            filled: vec![0; sets.number()],
            sets,
            ways,
            replacement,
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
            let victim = first + self.replacement.victim(set);
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
