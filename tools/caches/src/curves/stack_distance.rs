//! Exact stack distances: how many other lines were used since a line was last used.
//!
//! A fully associative LRU cache of C lines hits exactly the accesses of distance below C (Mattson, Gecsei, Slutz and
//! Traiger, *Evaluation techniques for storage hierarchies*, IBM Systems Journal 9, 1970), so the distances of one pass
//! are the misses of all sizes.
//!
//! The stack of lines by recency is in two parts. Its top, the [`TOP`] lines last used, has a *frame* for each line, and
//! one word holds the frames in order, four bits each; two in three accesses of a tree search find their line there. Every
//! other line is a bit in a row of bits, at the time when it left the top: the lines above it in the stack are the top and
//! the bits that follow its own (Bennett and Kruskal 1975, with Olken's live times only). Counts of 16 neighbours at each
//! of several levels, packed into words as lanes, make counting them a few dozen plain instructions, none of which some
//! processors lack, and hardly a branch. When the row is full, the bits are moved together, which happens once in several
//! times as many accesses as there are lines.

mod bits;
#[cfg(test)]
mod tests;

use bits::{Bits, PER_SUPER};

/// Lines at the top of the stack that have a frame.
const TOP: u32 = 16;

/// Not a slot: there are fewer.
const NO_SLOT: u32 = u32::MAX;

/// Where a line is: nowhere yet, in a frame, or at a time of the row, each with an offset of its own, so that no number
/// means two things.
const NEVER: u32 = 0;
const FIRST_FRAME: u32 = 1;
const FIRST_TIME: u32 = FIRST_FRAME + TOP;

/// Bits in the row for each line there may be: the more, the seldomer bits are moved, and the farther apart they lie.
const BITS_PER_LINE: u64 = 4;

/// Bits in the row for so many slots.
fn bits_for(slots: u64) -> u32 {
    (slots * BITS_PER_LINE).min(u64::from(u32::MAX - PER_SUPER - FIRST_TIME)) as u32
}

/// The recency stack of lines, numbered by slot.
pub(super) struct StackDistances {
    /// The frames, the one used last in the lowest four bits.
    order: u64,
    /// The slot in each frame.
    frames: [u32; TOP as usize],
    /// By slot: where it is.
    places: Vec<u32>,
    bits: Bits,
    /// Time of the next bit.
    now: u32,
    /// Distinct slots touched.
    touched: u64,
}

impl StackDistances {
    /// An empty stack for slots below `slots`, at most 2^31.
    pub(super) fn new(slots: u64) -> Self {
        assert!(slots <= 1 << 31);
        Self::with_bits(slots, bits_for(slots))
    }

    /// From now on there are so many slots, if they are more.
    pub(super) fn grow(&mut self, slots: u64) {
        if (self.places.len() as u64) < slots {
            self.places.resize(slots as usize, NEVER);
            self.bits.grow(bits_for(slots).next_multiple_of(PER_SUPER));
        }
    }

    /// The same with at least so many bits in the row, which must be more than there are slots.
    fn with_bits(slots: u64, bits: u32) -> Self {
        Self {
            order: 0xfedc_ba98_7654_3210,
            frames: [NO_SLOT; TOP as usize],
            places: vec![NEVER; slots as usize],
            bits: Bits::new(bits.max(1).next_multiple_of(PER_SUPER)),
            now: 0,
            touched: 0,
        }
    }

    /// Distinct slots touched so far; every distance is below this.
    pub(super) fn touched(&self) -> u64 {
        self.touched
    }

    /// Uses a slot. Returns how many others were used since its last use, or `None` if there was none.
    #[inline]
    pub(super) fn touch(&mut self, slot: u32) -> Option<u32> {
        let place = self.places[slot as usize];
        if place.wrapping_sub(FIRST_FRAME) < TOP {
            return Some(self.move_to_front(place - FIRST_FRAME));
        }
        let distance = if place == NEVER {
            self.touched += 1;
            None
        } else {
            let bit = place - FIRST_TIME;
            self.bits.clear(bit);
            Some(TOP + self.bits.after(bit, self.now))
        };
        // The last frame gives up its line, which becomes a bit.
        let frame = (self.order >> 60) as u32;
        let last = std::mem::replace(&mut self.frames[frame as usize], slot);
        self.order = self.order << 4 | u64::from(frame);
        self.places[slot as usize] = FIRST_FRAME + frame;
        if last != NO_SLOT {
            if self.now == self.bits.len() {
                self.now = self.bits.move_together(&mut self.places);
            }
            self.bits.set(self.now);
            self.places[last as usize] = FIRST_TIME + self.now;
            self.now += 1;
        }
        distance
    }

    /// Puts a frame first. Returns its old place in the order.
    #[inline]
    fn move_to_front(&mut self, frame: u32) -> u32 {
        const ONES: u64 = 0x1111_1111_1111_1111;
        // The four bits that are the frame become 0; the lowest such group is the lowest to borrow.
        let differs = self.order ^ (u64::from(frame) * ONES);
        let at = (differs.wrapping_sub(ONES) & !differs & (8 * ONES)).trailing_zeros() / 4;
        let up_to = u64::MAX >> (60 - 4 * at);
        self.order = (self.order & !up_to) | ((self.order << 4 | u64::from(frame)) & up_to);
        at
    }
}
