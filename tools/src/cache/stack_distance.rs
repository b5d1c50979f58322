//! Exact stack distances: how many other lines were used since a line was last used.
//!
//! A fully associative LRU cache of C lines hits exactly the accesses of distance below C (Mattson, Gecsei, Slutz and
//! Traiger, *Evaluation techniques for storage hierarchies*, IBM Systems Journal 9, 1970), so the distances of one pass
//! are the misses of all sizes.
//!
//! The stack of lines by recency is in two parts. Its top, the [`TOP`] lines last used, is a small array in order, which
//! two in three accesses of a tree search find their line in. Every other line is a bit in a row of bits, at the time when
//! it left the top: the lines above it in the stack are the top and the bits that follow its own (Bennett and Kruskal
//! 1975, with Olken's live times only). Sums over 64 neighbours at each of three levels make counting them a handful of
//! loads; they are byte-sized where they can be, so that plain vector instructions do it, and no instruction that some
//! processors lack is needed. When the row is full, the bits are moved together, which happens once in several times as
//! many accesses as there are lines.

/// Lines at the top of the stack that are kept in an array.
const TOP: usize = 16;

/// Not a slot: there are fewer.
const NO_SLOT: u32 = u32::MAX;

/// Not yet used. An explicit offset: the bit at time t is written t + 1.
const NEVER: u32 = 0;

/// Bits that one entry of each level counts.
const PER_WORD: u32 = 64;
const PER_GROUP: u32 = 64 * PER_WORD;
const PER_SUPER: u32 = 64 * PER_GROUP;

/// The least bits in the row.
const LEAST_BITS: u64 = PER_SUPER as u64;

/// Bits in the row for each line there may be: the more, the seldomer bits are moved, and the farther apart they lie.
const BITS_PER_LINE: u64 = 4;

/// The recency stack of lines, numbered by slot.
pub(super) struct StackDistances {
    /// The slots last used, the latest first.
    top: [u32; TOP],
    /// By slot: 1 + time of its bit. Out of date while the slot is in `top`.
    times: Vec<u32>,
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
        let bits = (slots * BITS_PER_LINE).clamp(LEAST_BITS, u64::from(u32::MAX) - u64::from(PER_SUPER));
        Self::with_bits(slots, bits as u32)
    }

    /// The same with at least so many bits in the row, which must be more than there are slots.
    fn with_bits(slots: u64, bits: u32) -> Self {
        Self {
            top: [NO_SLOT; TOP],
            times: vec![NEVER; slots as usize],
            bits: Bits::new(bits.next_multiple_of(PER_GROUP)),
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
        let last = self.top[TOP - 1];
        let at = to_front(&mut self.top, slot);
        if at < TOP as u32 {
            return Some(at);
        }
        let time = &mut self.times[slot as usize];
        let distance = if *time == NEVER {
            *time = NEVER + 1;
            self.touched += 1;
            None
        } else {
            let bit = *time - 1;
            self.bits.clear(bit);
            Some(TOP as u32 + self.bits.after(bit, self.now))
        };
        if last != NO_SLOT {
            if self.now == self.bits.len() {
                self.now = self.bits.move_together(&mut self.times);
            }
            self.bits.set(self.now);
            self.times[last as usize] = self.now + 1;
            self.now += 1;
        }
        distance
    }
}

/// Puts `slot` first and moves those before it one place back. Returns its old place, or [`TOP`] if it had none; then the
/// last one is dropped.
#[inline]
fn to_front(top: &mut [u32; TOP], slot: u32) -> u32 {
    // Where it is, is anyone's guess, so all places are looked at and rewritten, some at a time and without a branch.
    let mut at = 0;
    for (i, &other) in top.iter().enumerate() {
        at += if other == slot { (TOP - i) as u32 } else { 0 };
    }
    let at = TOP as u32 - at;
    let mut shifted = [slot; TOP];
    shifted[1..].copy_from_slice(&top[..TOP - 1]);
    for (i, (place, &before)) in top.iter_mut().zip(&shifted).enumerate() {
        *place = if i as u32 <= at { before } else { *place };
    }
    at
}

/// A row of bits that counts those that follow a place.
struct Bits {
    words: Vec<u64>,
    /// Bits set in each word, 64 words together.
    by_word: Vec<[u8; 64]>,
    /// Bits set in each 64 words, 64 of them together.
    by_group: Vec<[u16; 64]>,
    /// Bits set in each 64 groups.
    by_super: Vec<u32>,
}

impl Bits {
    /// No bit set. `len` is a multiple of [`PER_GROUP`].
    fn new(len: u32) -> Self {
        Self {
            words: vec![0; (len / PER_WORD) as usize],
            by_word: vec![[0; 64]; (len / PER_GROUP) as usize],
            by_group: vec![[0; 64]; len.div_ceil(PER_SUPER) as usize],
            by_super: vec![0; len.div_ceil(PER_SUPER) as usize],
        }
    }

    fn len(&self) -> u32 {
        self.words.len() as u32 * PER_WORD
    }

    #[inline]
    fn set(&mut self, bit: u32) {
        let (word, group, sup) = places(bit);
        self.words[word] |= 1 << (bit % PER_WORD);
        self.by_word[group][word % 64] += 1;
        self.by_group[sup][group % 64] += 1;
        self.by_super[sup] += 1;
    }

    #[inline]
    fn clear(&mut self, bit: u32) {
        let (word, group, sup) = places(bit);
        self.words[word] &= !(1 << (bit % PER_WORD));
        self.by_word[group][word % 64] -= 1;
        self.by_group[sup][group % 64] -= 1;
        self.by_super[sup] -= 1;
    }

    /// Bits set after `bit`, if none is set from `end` on.
    #[inline]
    fn after(&self, bit: u32, end: u32) -> u32 {
        let (word, group, sup) = places(bit);
        let in_word = (self.words[word] >> (bit % PER_WORD) >> 1).count_ones();
        let mut sum = in_word + after_in_bytes(&self.by_word[group], word % 64);
        sum += after_in_words(&self.by_group[sup], group % 64);
        let last = (end / PER_SUPER) as usize;
        if sup < last {
            sum += self.by_super[sup + 1..self.by_super.len().min(last + 1)].iter().sum::<u32>();
        }
        sum
    }

    /// Moves all bits to the beginning of the row, in order, and their times with them. Returns their number.
    #[cold]
    fn move_together(&mut self, times: &mut [u32]) -> u32 {
        let mut live = 0;
        let mut before = Vec::with_capacity(self.words.len());
        for word in &self.words {
            before.push(live);
            live += word.count_ones();
        }
        assert!(live < self.len(), "there are more bits than slots");
        for time in times.iter_mut().filter(|time| **time != NEVER) {
            let bit = *time - 1;
            let word = (bit / PER_WORD) as usize;
            let below = self.words[word] & ((1 << (bit % PER_WORD)) - 1);
            // A slot in the top has no bit; what it gets instead is as good as what it had.
            *time = before[word] + below.count_ones() + 1;
        }
        *self = Self::new(self.len());
        (0..live).for_each(|bit| self.set(bit));
        live
    }
}

/// Indices of the word, the group and the super-group of a bit.
#[inline]
fn places(bit: u32) -> (usize, usize, usize) {
    ((bit / PER_WORD) as usize, (bit / PER_GROUP) as usize, (bit / PER_SUPER) as usize)
}

/// Sum of the counts after index `at`; each is at most 64.
#[inline]
fn after_in_bytes(counts: &[u8; 64], at: usize) -> u32 {
    let at = at as u8;
    let mut sum = 0_u32;
    for (i, &count) in (0_u8..).zip(counts) {
        sum += u32::from(if i > at { count } else { 0 });
    }
    sum
}

/// Sum of the counts after index `at`; each is at most 4,096.
#[inline]
fn after_in_words(counts: &[u16; 64], at: usize) -> u32 {
    let at = at as u16;
    let mut sum = 0_u32;
    for (i, &count) in (0_u16..).zip(counts) {
        sum += u32::from(if i > at { count } else { 0 });
    }
    sum
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
        for (slots, bits) in [(3000, 4096), (4000, 8192), (100_000, 1 << 17)] {
            let uses = random_uses(slots, slots, 400_000);
            let (mut short, mut long) =
                (StackDistances::with_bits(slots, bits), { StackDistances::with_bits(slots, 1 << 20) });
            for (i, &slot) in uses.iter().enumerate() {
                assert_eq!(short.touch(slot), long.touch(slot), "use {i} of {slots} slots in {bits} bits");
            }
            assert!(slots != 3000 || short.now < long.now, "the row was full at least once");
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
