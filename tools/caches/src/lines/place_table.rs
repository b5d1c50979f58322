//! Which place a page has: open addressing (Knuth, *The Art of Computer Programming* 3, 6.4, algorithm L) over places alone.
//!
//! The numbers of pages lie beside, by place, so that a page costs the table 8 to 16 bytes. A table of the standard
//! library has its keys in itself: 20 to 40 bytes, and once more while it grows. And it would not tell a first guess, which can be
//! asked for many pages before the first answer is needed.

/// Places by the hash of their page; of the pages, somebody else has the numbers.
pub(super) struct PlaceTable {
    /// Twice as many as there are pages at least, a power of two.
    entries: Vec<u32>,
}

/// Not a place.
const NONE: u32 = u32::MAX;
/// Entries of an empty table.
const LEAST: usize = 1 << 10;

impl PlaceTable {
    pub(super) fn new() -> Self {
        Self { entries: vec![NONE; LEAST] }
    }

    /// The place that the page has, most often, if it has one; no place, or that of another page, else.
    #[inline]
    pub(super) fn first_guess(&self, page: u64) -> u32 {
        self.entries[self.home(page)]
    }

    /// The place of a page: the one it has, or the next one, and then its number is behind those of the others.
    pub(super) fn place(&mut self, page: u64, pages: &mut Vec<u64>) -> u32 {
        let at = self.entry_of(page, pages);
        if self.entries[at] != NONE {
            return self.entries[at];
        }
        let place = pages.len() as u32;
        self.entries[at] = place;
        pages.push(page);
        if pages.len() > self.entries.len() / 2 {
            self.grow(pages);
        }
        place
    }

    /// The entry of a page, or the empty one where it would be.
    fn entry_of(&self, page: u64, pages: &[u64]) -> usize {
        let mut at = self.home(page);
        while self.entries[at] != NONE && pages[self.entries[at] as usize] != page {
            at = (at + 1) & (self.entries.len() - 1);
        }
        at
    }

    /// Makes the table twice as long. The old one is not needed for that, so it goes first.
    #[cold]
    fn grow(&mut self, pages: &[u64]) {
        let length = 2 * self.entries.len();
        self.entries = vec![];
        self.entries = vec![NONE; length];
        for (place, &page) in pages.iter().enumerate() {
            // All are different, so no number has to be looked at.
            let mut at = self.home(page);
            while self.entries[at] != NONE {
                at = (at + 1) & (length - 1);
            }
            self.entries[at] = place as u32;
        }
    }

    /// Where the search for a page begins.
    #[inline]
    fn home(&self, page: u64) -> usize {
        // Both halves of a long product, so that all bits of a number make a difference to all of the hash.
        let product = u128::from(page ^ GOLDEN) * u128::from(GOLDEN);
        ((product >> 64) as u64 ^ product as u64) as usize & (self.entries.len() - 1)
    }
}

/// 2^64 over the golden ratio, odd.
pub(super) const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    #[test]
    fn pages_keep_their_places() {
        let (mut table, mut pages, mut known) = (PlaceTable::new(), vec![], HashMap::new());
        let number = |i: u64| match i % 3 {
            0 => i << 30,
            1 => i,
            _ => i.wrapping_mul(GOLDEN) >> 12,
        };
        for i in (0..20_000).chain(0..30_000) {
            let page = number(i);
            let next = known.len() as u32;
            let place = *known.entry(page).or_insert(next);
            assert_eq!(table.place(page, &mut pages), place, "page {page:#x}");
            assert_eq!(pages[place as usize], page);
        }
        assert_eq!(pages.len(), known.len());
        let guessed =
            pages.iter().enumerate().filter(|&(place, &page)| table.first_guess(page) == place as u32).count();
        assert!(guessed * 3 > pages.len() * 2, "{guessed} of {} are where they are looked for first", pages.len());
    }
}
