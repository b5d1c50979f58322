//! Bytes changed by chance, the same for the same seed.

use pm_random::Random;
use std::ops::Range;

/// Numbers at which something begins or ends.
const EDGES: [u64; 14] =
    [0, 1, 2, 7, 8, 0x7f, 0x80, 0xff, 0xffff, 0x1_0000, 0x7fff_ffff, 0xffff_ffff, 0x8000_0000_0000_0000, u64::MAX];
/// Longest input, in bytes.
pub(super) const LONGEST: usize = 1 << 16;
/// Most changes to an input at once.
const MOST_CHANGES: usize = 6;

/// Changes bytes.
pub struct Mutator(Random);

impl Mutator {
    /// Of this seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Random::new(&[seed]))
    }

    fn below(&mut self, most: usize) -> usize {
        usize::try_from(self.0.next_u64() % most.max(1) as u64).expect("below a usize")
    }

    fn byte(&mut self) -> u8 {
        self.0.next_u64().to_le_bytes()[0]
    }

    /// A stretch of so many bytes, mostly a short one.
    fn stretch(&mut self, length: usize) -> Range<usize> {
        let start = self.below(length + 1);
        let most = if self.below(4) == 0 { length } else { 16 };
        start..(start + self.below(most.min(length) + 1)).min(length)
    }

    /// One of these inputs, changed here and there.
    pub fn mutated(&mut self, seeds: &[Vec<u8>]) -> Vec<u8> {
        let mut data = seeds[self.below(seeds.len())].clone();
        for _ in 0..=self.below(MOST_CHANGES) {
            self.change(&mut data, seeds);
        }
        data.truncate(LONGEST);
        data
    }

    fn change(&mut self, data: &mut Vec<u8>, seeds: &[Vec<u8>]) {
        let at = self.below(data.len());
        match self.below(9) {
            0 | 1 if !data.is_empty() => data[at] ^= 1 << self.below(8),
            2 if !data.is_empty() => data[at] = self.byte(),
            3 | 4 => {
                // One about an edge, in any width.
                let edge = EDGES[self.below(EDGES.len())];
                let number = [edge, edge.wrapping_add(1), edge.wrapping_sub(1)][self.below(3)].to_le_bytes();
                let width = [1, 2, 4, 8][self.below(4)];
                for (byte, new) in data.iter_mut().skip(at).zip(&number[..width]) {
                    *byte = *new;
                }
            }
            5 => drop(data.drain(self.stretch(data.len()))),
            6 => {
                let copy = data[self.stretch(data.len())].to_vec();
                data.splice(at..at, copy);
            }
            7 => {
                let other = &seeds[self.below(seeds.len())];
                let piece = other[self.stretch(other.len())].to_vec();
                let end = (at + piece.len()).min(data.len());
                let until = if self.below(2) == 0 { at } else { end };
                data.splice(at..until, piece);
            }
            _ => {
                let random: Vec<u8> = (0..self.below(9)).map(|_| self.byte()).collect();
                data.splice(at..at, random);
            }
        }
    }
}
