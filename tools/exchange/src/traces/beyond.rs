//! Addresses beyond 64 bits: numbers of objects times the bytes of one.
//!
//! Hashes of 64 bits times a line of 128 bytes are numbers of 71 bits. What a cache counts depends on which lines are the same,
//! and with sets on the low bits of their numbers; so a page whose address has more than 64 bits is put where its low bits say,
//! and if another page is there already, where they say with other high bits. The same is done for every page, of however few
//! bits, so that each keeps a place of its own.

use std::collections::{HashMap, HashSet};

/// log2 of the bytes of a page.
const SHIFT: u32 = 12;
/// Bits of the number of a page that has an address.
const BITS: u32 = 64 - SHIFT;
/// Low bits that a page keeps, more than choose among the sets of any cache, as long as there are places that have them.
const KEPT: u32 = 40;
/// Low bits that it keeps whatever happens: those that choose among the sets of a cache of 2^40 bytes.
const LEAST_KEPT: u32 = 28;

/// The pages met, and where they are.
#[derive(Default)]
pub(super) struct Beyond {
    /// The page met last, and where it is.
    last: Option<(u128, u64)>,
    places: HashMap<u128, u64>,
    taken: HashSet<u64>,
    /// How many places were tried for pages of these low bits.
    next: HashMap<u64, u64>,
}

impl Beyond {
    /// Where `len` bytes are that begin at `unit` times `number`; `None` if they go on in a page that is not behind theirs, or
    /// no place is left.
    pub(super) fn address(&mut self, number: u64, unit: u64, idle: u64, len: u32) -> Option<u64> {
        let first = (u128::from(number) * u128::from(unit)) & !u128::from(idle);
        let last = first + u128::from(len.max(1) - 1);
        let place = self.place(first >> SHIFT)?;
        for page in (first >> SHIFT) + 1..=last >> SHIFT {
            if u128::from(self.place(page)?) != u128::from(place) + (page - (first >> SHIFT)) {
                return None;
            }
        }
        Some(place << SHIFT | (first as u64 & ((1 << SHIFT) - 1)))
    }

    /// Where a page is put; `None` if no place is left that has its low bits.
    fn place(&mut self, page: u128) -> Option<u64> {
        if let Some((known, place)) = self.last
            && known == page
        {
            return Some(place);
        }
        let place = match self.places.get(&page) {
            Some(&place) => place,
            None => {
                let place = self.free(page as u64 & ((1 << BITS) - 1))?;
                self.places.insert(page, place);
                place
            }
        };
        self.last = Some((page, place));
        Some(place)
    }

    /// Takes the place itself, or the next with its low bits: first with other high bits, then with others in the middle.
    fn free(&mut self, own: u64) -> Option<u64> {
        if self.taken.insert(own) {
            return Some(own);
        }
        let low = own & ((1 << KEPT) - 1);
        // What was tried for these low bits is taken for good.
        let next = self.next.entry(low).or_default();
        while *next < 1 << (BITS - LEAST_KEPT) {
            let (high, middle) = (*next & ((1 << (BITS - KEPT)) - 1), *next >> (BITS - KEPT));
            *next += 1;
            let place = high << KEPT | (low ^ middle << LEAST_KEPT);
            if self.taken.insert(place) {
                return Some(place);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_stay_apart_and_keep_their_low_bits() {
        let mut beyond = Beyond::default();
        // Numbers that 64 bits cannot tell apart once they are multiplied, small ones among them.
        let numbers: Vec<u64> = (0..128u64).flat_map(|high| [1, 77, 1 << 50].map(|low| high << 57 | low)).collect();
        let places: Vec<u64> = numbers.iter().map(|&number| beyond.address(number, 128, 0, 128).unwrap()).collect();
        assert_eq!(places.iter().collect::<HashSet<_>>().len(), numbers.len());
        for (number, place) in numbers.iter().zip(&places) {
            assert_eq!(number.wrapping_mul(128) & ((1 << 52) - 1), place & ((1 << 52) - 1));
            assert_eq!(beyond.address(*number, 128, 0, 128), Some(*place), "where it was");
        }
        assert_eq!(places[..3], [128, 77 * 128, 1 << 57], "what fits stays where it is");
    }

    #[test]
    fn more_pages_of_the_same_low_bits_than_high_bits_tell_apart_stay_apart() {
        let mut beyond = Beyond::default();
        let places: HashSet<u64> =
            (0..20_000u64).map(|number| beyond.address(number << 40, 4096, 0, 1).expect("a place")).collect();
        assert_eq!(places.len(), 20_000);
        assert!(places.iter().all(|place| place & ((1 << 40) - 1) == 0));
    }

    #[test]
    fn what_goes_on_in_another_place_is_none() {
        let mut beyond = Beyond::default();
        assert_eq!(beyond.address(1, 4096, 0, 8192), Some(4096));
        assert_eq!(beyond.address((1 << 52) | 3, 4096, 0, 1), Some(3 * 4096));
        assert_eq!(beyond.address(2, 4096, 0, 8192), None);
        assert_eq!(beyond.address(u64::MAX, 4096, 0, 4096), Some(u64::MAX - 4095));
        assert_eq!(beyond.address(u64::MAX, 4096, 0, 4097), None);
    }
}
