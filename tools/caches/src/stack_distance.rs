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

/// Lines at the top of the stack that have a frame.
const TOP: u32 = 16;

/// Not a slot: there are fewer.
const NO_SLOT: u32 = u32::MAX;

/// Where a line is: nowhere yet, in a frame, or at a time of the row, each with an offset of its own, so that no number
/// means two things.
const NEVER: u32 = 0;
const FIRST_FRAME: u32 = 1;
const FIRST_TIME: u32 = FIRST_FRAME + TOP;

/// Bits that one entry of each level counts.
const PER_WORD: u32 = 64;
const PER_GROUP: u32 = 16 * PER_WORD;
const PER_BLOCK: u32 = 16 * PER_GROUP;
const PER_SUPER: u32 = 16 * PER_BLOCK;

/// Bits in the row for each line there may be: the more, the seldomer bits are moved, and the farther apart they lie.
const BITS_PER_LINE: u64 = 4;

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
        let most = u64::from(u32::MAX - PER_SUPER - FIRST_TIME);
        Self::with_bits(slots, (slots * BITS_PER_LINE).min(most) as u32)
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

/// A row of bits that counts those that follow a place.
struct Bits {
    words: Vec<u64>,
    /// Bits set in each word: 16 lanes of a byte.
    by_word: Vec<[u64; 2]>,
    /// Bits set in each 16 words: 16 lanes of two bytes.
    by_group: Vec<[u64; 4]>,
    /// Bits set in each 16 groups.
    by_block: Vec<[u32; 16]>,
    /// Bits set in each 16 blocks.
    by_super: Vec<u32>,
}

impl Bits {
    /// No bit set. `len` is a multiple of [`PER_SUPER`].
    fn new(len: u32) -> Self {
        Self {
            words: vec![0; (len / PER_WORD) as usize],
            by_word: vec![[0; 2]; (len / PER_GROUP) as usize],
            by_group: vec![[0; 4]; (len / PER_BLOCK) as usize],
            by_block: vec![[0; 16]; (len / PER_SUPER) as usize],
            by_super: vec![0; (len / PER_SUPER) as usize],
        }
    }

    fn len(&self) -> u32 {
        self.words.len() as u32 * PER_WORD
    }

    #[inline]
    fn set(&mut self, bit: u32) {
        let at = Place::of(bit);
        self.words[at.word] |= 1 << (bit % PER_WORD);
        self.by_word[at.group][at.word % 16 / 8] += 1 << (at.word % 8 * 8);
        self.by_group[at.block][at.group % 16 / 4] += 1 << (at.group % 4 * 16);
        self.by_block[at.sup][at.block % 16] += 1;
        self.by_super[at.sup] += 1;
    }

    #[inline]
    fn clear(&mut self, bit: u32) {
        let at = Place::of(bit);
        self.words[at.word] &= !(1 << (bit % PER_WORD));
        self.by_word[at.group][at.word % 16 / 8] -= 1 << (at.word % 8 * 8);
        self.by_group[at.block][at.group % 16 / 4] -= 1 << (at.group % 4 * 16);
        self.by_block[at.sup][at.block % 16] -= 1;
        self.by_super[at.sup] -= 1;
    }

    /// Bits set after `bit`, if none is set from `end` on.
    #[inline]
    fn after(&self, bit: u32, end: u32) -> u32 {
        let at = Place::of(bit);
        let in_word = (self.words[at.word] >> (bit % PER_WORD) >> 1).count_ones();
        let in_group = bytes_after(self.by_word[at.group], at.word % 16);
        let in_block = halves_after(self.by_group[at.block], at.group % 16);
        let mut sum = in_word + in_group + in_block;
        for (i, &count) in (0..).zip(&self.by_block[at.sup]) {
            sum += if i > at.block % 16 { count } else { 0 };
        }
        let end = ((end / PER_SUPER) as usize + 1).min(self.by_super.len());
        sum + self.by_super.get(at.sup + 1..end).map_or(0, |counts| counts.iter().sum())
    }

    /// Moves all bits to the beginning of the row, in order, and the places of slots with them. Returns their number.
    #[cold]
    fn move_together(&mut self, places: &mut [u32]) -> u32 {
        let mut live = 0;
        let mut before = Vec::with_capacity(self.words.len());
        for word in &self.words {
            before.push(live);
            live += word.count_ones();
        }
        assert!(live < self.len(), "there are more bits than slots");
        for place in places.iter_mut().filter(|place| **place >= FIRST_TIME) {
            let bit = *place - FIRST_TIME;
            let word = (bit / PER_WORD) as usize;
            let below = self.words[word] & ((1 << (bit % PER_WORD)) - 1);
            *place = FIRST_TIME + before[word] + below.count_ones();
        }
        *self = Self::new(self.len());
        (0..live).for_each(|bit| self.set(bit));
        live
    }
}

/// Where a bit counts.
struct Place {
    word: usize,
    group: usize,
    block: usize,
    sup: usize,
}

impl Place {
    #[inline]
    fn of(bit: u32) -> Self {
        let [word, group, block, sup] = [PER_WORD, PER_GROUP, PER_BLOCK, PER_SUPER].map(|per| (bit / per) as usize);
        Self { word, group, block, sup }
    }
}

/// Sum of the byte lanes after lane `at`; each is at most 64.
#[inline]
fn bytes_after([low, high]: [u64; 2], at: usize) -> u32 {
    const EVEN: u64 = 0x00ff_00ff_00ff_00ff;
    let (part, rest) = if at < 8 { (low, high) } else { (high, 0) };
    let sum = (part >> (at % 8 * 8) >> 8) + rest;
    lanes((sum & EVEN) + (sum >> 8 & EVEN))
}

/// Sum of the two-byte lanes after lane `at`; each is at most 1,024.
#[inline]
fn halves_after(words: [u64; 4], at: usize) -> u32 {
    let mut sum = words[at / 4] >> (at % 4 * 16) >> 16;
    for (i, word) in words.into_iter().enumerate() {
        sum += if i > at / 4 { word } else { 0 };
    }
    lanes(sum)
}

/// Sum of four two-byte lanes, below 2^16.
#[inline]
fn lanes(sum: u64) -> u32 {
    (sum.wrapping_mul(0x0001_0001_0001_0001) >> 48) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition: the distinct slots between a use and the one before.
    fn brute_force(uses: &[u32], at: usize) -> Option<u32> {
        let before = uses[..at].iter().rposition(|&slot| slot == uses[at])?;
        let mut between = uses[before + 1..at].to_vec();
        between.sort_unstable();
        between.dedup();
        Some(between.len() as u32)
    }

    fn random_uses(seed: u64, slots: u64, length: usize) -> Vec<u32> {
        let mut state = seed;
        let mut next = move |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        };
        let mut around = 0;
        let uses = (0..length).map(|i| {
            // Now anywhere, now in a neighbourhood that wanders, now the next one.
            around = match (i / 100) % 3 {
                0 => next(slots),
                1 => (around + next(9)) % slots,
                _ => (around + 1) % slots,
            };
            around as u32
        });
        uses.collect()
    }

    #[test]
    fn distances_are_those_of_the_definition() {
        for seed in 0..60 {
            let slots = [1, 2, 15, 16, 17, 18, 40, 200, 900][seed as usize % 9];
            let uses = random_uses(seed, slots, 1500);
            let mut stack = StackDistances::new(slots);
            for (i, &slot) in uses.iter().enumerate() {
                assert_eq!(stack.touch(slot), brute_force(&uses, i), "seed {seed}, use {i}");
            }
        }
    }

    #[test]
    fn a_row_that_is_full_loses_nothing() {
        // Rows so short that bits are moved together often, against one that never fills.
        for (slots, bits) in [(3000, 4096), (200_000, 1 << 18)] {
            let uses = random_uses(slots, slots, 400_000);
            let (mut short, mut long) =
                (StackDistances::with_bits(slots, bits), { StackDistances::with_bits(slots, 1 << 20) });
            for (i, &slot) in uses.iter().enumerate() {
                assert_eq!(short.touch(slot), long.touch(slot), "use {i} of {slots} slots in {bits} bits");
            }
            assert!(short.now < long.now, "the row was full at least once");
        }
    }

    #[test]
    fn a_loop_has_one_distance_at_every_level() {
        // Distances from the top array to beyond one super-group of bits.
        for slots in [1_u64, 15, 16, 17, 64, 65, 4096, 4111, 70_000, 300_000] {
            let mut stack = StackDistances::new(slots);
            for round in 0..3 {
                for slot in 0..slots as u32 {
                    let expected = (round > 0).then_some(slots as u32 - 1);
                    assert_eq!(stack.touch(slot), expected, "{slots} slots");
                }
            }
            assert_eq!(stack.touched(), slots);
        }
    }
}
