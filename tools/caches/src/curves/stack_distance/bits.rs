//! A row of bits that counts those that follow a place, by counts of 16 neighbours at each of several levels.

use super::FIRST_TIME;

/// Bits that one entry of each level counts.
const PER_WORD: u32 = 64;
const PER_GROUP: u32 = 16 * PER_WORD;
const PER_BLOCK: u32 = 16 * PER_GROUP;
pub(super) const PER_SUPER: u32 = 16 * PER_BLOCK;

/// A row of bits that counts those that follow a place.
pub(super) struct Bits {
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
    pub(super) fn new(len: u32) -> Self {
        let mut bits = Self { words: vec![], by_word: vec![], by_group: vec![], by_block: vec![], by_super: vec![] };
        bits.grow(len);
        bits
    }

    /// Bits that are not set behind the others, up to `len` of them, a multiple of [`PER_SUPER`].
    pub(super) fn grow(&mut self, len: u32) {
        if len > self.len() {
            self.words.resize((len / PER_WORD) as usize, 0);
            self.by_word.resize((len / PER_GROUP) as usize, [0; 2]);
            self.by_group.resize((len / PER_BLOCK) as usize, [0; 4]);
            self.by_block.resize((len / PER_SUPER) as usize, [0; 16]);
            self.by_super.resize((len / PER_SUPER) as usize, 0);
        }
    }

    pub(super) fn len(&self) -> u32 {
        self.words.len() as u32 * PER_WORD
    }

    #[inline]
    pub(super) fn set(&mut self, bit: u32) {
        let at = Counters::of(bit);
        self.words[at.word] |= 1 << (bit % PER_WORD);
        self.by_word[at.group][at.word % 16 / 8] += 1 << (at.word % 8 * 8);
        self.by_group[at.block][at.group % 16 / 4] += 1 << (at.group % 4 * 16);
        self.by_block[at.sup][at.block % 16] += 1;
        self.by_super[at.sup] += 1;
    }

    #[inline]
    pub(super) fn clear(&mut self, bit: u32) {
        let at = Counters::of(bit);
        self.words[at.word] &= !(1 << (bit % PER_WORD));
        self.by_word[at.group][at.word % 16 / 8] -= 1 << (at.word % 8 * 8);
        self.by_group[at.block][at.group % 16 / 4] -= 1 << (at.group % 4 * 16);
        self.by_block[at.sup][at.block % 16] -= 1;
        self.by_super[at.sup] -= 1;
    }

    /// Bits set after `bit`, if none is set from `end` on.
    #[inline]
    pub(super) fn after(&self, bit: u32, end: u32) -> u32 {
        let at = Counters::of(bit);
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

    /// Moves all bits to the beginning of the row, in order, and with them the places of slots, which for a bit are
    /// [`FIRST_TIME`] and more. Returns their number.
    #[cold]
    pub(super) fn move_together(&mut self, places: &mut [u32]) -> u32 {
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

/// The counters that count a bit.
struct Counters {
    word: usize,
    group: usize,
    block: usize,
    sup: usize,
}

impl Counters {
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
