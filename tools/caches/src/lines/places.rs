//! Places for the pages of a trace whose addresses nobody has laid out.
//!
//! A page gets the next free place when it is touched for the first time, so whatever 64-bit addresses a trace has and
//! however far apart, its lines are numbered without gaps in one reading and memory grows with the pages touched. Pages side by
//! side need no places side by side: of an access the places of its first and of its last byte are told, and one that goes on
//! in more than two pages becomes an access for each. Lines end where pages do, so there are as many line accesses as ever.

use std::sync::Arc;

use super::place_table::{GOLDEN, PlaceTable};
use super::{Accesses, Shape, Shapes};
use crate::SpanRule;

/// log2 of the bytes of a page, if no line is longer: those that keep regions apart.
pub(crate) const PAGE_SHIFT: u32 = 12;

/// log2 of the pages remembered with their places, at an index that is a hash: most accesses need no look at the table.
const RECENT: u32 = 12;

/// Not a page: a page's number has 52 bits at most.
const NO_PAGE: u64 = u64::MAX;

/// The pages touched, and the place of each.
pub(crate) struct Places {
    /// log2 of the bytes of a page.
    shift: u32,
    recent: Box<[(u64, u32)]>,
    places: PlaceTable,
    /// Page numbers, by place.
    pages: Arc<Vec<u64>>,
    /// Accesses to pages that are not remembered, and the places that their pages may have.
    unknown: Vec<(u32, u32)>,
    /// Of the accesses taken last, first and last byte in the places of their pages, as many as were taken.
    firsts: Vec<u64>,
    lasts: Vec<u64>,
    taken: usize,
    /// Their shapes, if they had to be cut, and which are further pieces.
    pieces: Vec<Shape>,
    further: Vec<bool>,
}

impl Places {
    /// None yet, of pages of 2^`shift` bytes.
    pub(crate) fn new(shift: u32) -> Self {
        Self {
            shift,
            recent: vec![(NO_PAGE, 0); 1 << RECENT].into(),
            places: PlaceTable::new(),
            pages: Arc::default(),
            unknown: vec![],
            firsts: vec![],
            lasts: vec![],
            taken: 0,
            pieces: vec![],
            further: vec![],
        }
    }

    /// Numbers of the pages touched, by place. Who keeps them lets go of them before others are taken.
    pub(crate) fn pages(&self) -> &Arc<Vec<u64>> {
        &self.pages
    }

    /// Finds places for the pages of these accesses. Where `span` wants the first line only, what lies in further pages is left
    /// out, but for its pages.
    ///
    /// # Panics
    /// If an access goes on beyond the last address, or somebody keeps the [`pages`](Self::pages).
    pub(crate) fn take(&mut self, accesses: &Accesses, span: SpanRule) {
        let low = (1 << self.shift) - 1;
        let number = accesses.len();
        self.firsts.resize(self.firsts.len().max(number), 0);
        self.lasts.resize(self.firsts.len(), 0);
        self.taken = number;
        self.pieces.clear();
        let all = if span == SpanRule::First { 0 } else { u64::MAX };
        // Out of the way of the table, so that where they lie is known for the whole pass.
        let (mut firsts, mut lasts) = (std::mem::take(&mut self.firsts), std::mem::take(&mut self.lasts));
        self.unknown.clear();
        let longest = match accesses.shapes {
            Shapes::Alike(shape) => self.look(accesses.offsets, |_| shape, span, &mut firsts, &mut lasts),
            Shapes::Each(shapes) => self.look(accesses.offsets, |i| shapes[i], span, &mut firsts, &mut lasts),
        };
        self.find(accesses, all, &mut firsts, &mut lasts);
        (self.firsts, self.lasts) = (firsts, lasts);
        // Further pages than two have to be there too.
        if longest > low {
            self.cut(accesses, span);
        }
    }

    /// Finds the places of the pages that are remembered, and of second pages; how many bytes the longest access has that has one.
    #[inline]
    fn look(
        &mut self,
        offsets: &[u64],
        shape: impl Fn(usize) -> Shape,
        span: SpanRule,
        firsts: &mut [u64],
        lasts: &mut [u64],
    ) -> u64 {
        let (shift, low) = (self.shift, (1 << self.shift) - 1);
        let all = if span == SpanRule::First { 0 } else { u64::MAX };
        let mut longest = 0;
        for (i, (&offset, (to_first, to_last))) in offsets.iter().zip(firsts.iter_mut().zip(lasts)).enumerate() {
            let page = offset >> shift;
            let (known, place) = self.recent[recent(page)];
            let more = u64::from(shape(i).len().max(1) - 1);
            *to_first = u64::from(place) << shift | (offset & low);
            *to_last = *to_first + (more & all);
            if known != page {
                self.unknown.push((i as u32, 0));
            }
            if (offset & low) + more > low {
                longest = longest.max(more);
                let last = offset.checked_add(more).expect("an access outside of its region: beyond the last address");
                let place = u64::from(self.place(last >> shift));
                if span != SpanRule::First {
                    *to_last = place << shift | (last & low);
                }
            }
        }
        longest
    }

    /// Mends the places of the unknown pages of accesses. Where pages are far apart, each look at the table waits for memory: so
    /// all guesses are asked for before one is used.
    fn find(&mut self, accesses: &Accesses, all: u64, firsts: &mut [u64], lasts: &mut [u64]) {
        let (shift, low) = (self.shift, (1 << self.shift) - 1);
        let mut unknown = std::mem::take(&mut self.unknown);
        for (i, guess) in &mut unknown {
            *guess = self.places.first_guess(accesses.offsets[*i as usize] >> shift);
        }
        for &(i, guess) in &unknown {
            let i = i as usize;
            let (page, in_page) = (accesses.offsets[i] >> shift, accesses.offsets[i] & low);
            let place = match self.pages.get(guess as usize) {
                Some(&number) if number == page => self.remember(page, guess),
                _ => self.place(page),
            };
            firsts[i] = u64::from(place) << shift | in_page;
            let more = u64::from(accesses.shapes.at(i).len().max(1) - 1) & all;
            // What ends in another page knows that page's place.
            if in_page + more <= low {
                lasts[i] = firsts[i] + more;
            }
        }
        self.unknown = unknown;
    }

    /// The same where some accesses go on in more than two pages: an access for each page.
    #[cold]
    fn cut(&mut self, accesses: &Accesses, span: SpanRule) {
        let (shift, low) = (self.shift, (1 << self.shift) - 1);
        self.firsts.clear();
        self.lasts.clear();
        self.further.clear();
        for (i, &offset) in accesses.offsets.iter().enumerate() {
            let shape = accesses.shapes.at(i);
            let last = offset + u64::from(shape.len().max(1) - 1);
            for page in offset >> shift..=last >> shift {
                let place = u64::from(self.place(page)) << shift;
                let (from, to) = (offset.max(page << shift), last.min(page << shift | low));
                if from == offset || span != SpanRule::First {
                    let of_piece = if span == SpanRule::First { from } else { to };
                    self.firsts.push(place | (from & low));
                    self.further.push(from != offset);
                    self.lasts.push(place | (of_piece & low));
                    self.pieces.push(shape.of_len(shape.len().min((to - from + 1) as u32)));
                }
            }
        }
        self.taken = self.firsts.len();
    }

    /// The accesses taken last, with the places of their pages instead of the pages.
    pub(crate) fn placed<'a>(&'a self, taken: &Accesses<'a>) -> Accesses<'a> {
        let (offsets, lasts) = (&self.firsts[..self.taken], Some(&self.lasts[..self.taken]));
        match self.pieces.is_empty() {
            true => Accesses { offsets, lasts, ..*taken },
            false => Accesses { offsets, lasts, further: Some(&self.further), shapes: Shapes::Each(&self.pieces) },
        }
    }

    /// The place of a page.
    #[inline]
    fn place(&mut self, page: u64) -> u32 {
        let (known, place) = self.recent[recent(page)];
        if known == page { place } else { self.look_up(page) }
    }

    #[inline(never)]
    fn look_up(&mut self, page: u64) -> u32 {
        let pages = Arc::get_mut(&mut self.pages).expect("nobody keeps the pages while new ones are found");
        let place = self.places.place(page, pages);
        self.remember(page, place)
    }

    #[inline]
    fn remember(&mut self, page: u64, place: u32) -> u32 {
        self.recent[recent(page)] = (page, place);
        place
    }
}

/// Where a page is remembered.
#[inline]
fn recent(page: u64) -> usize {
    // Pages side by side are far apart in this order, and multiples of powers of two too (Knuth, *The Art of Computer
    // Programming* 3, 6.4, on multiplicative hashing).
    (page.wrapping_mul(GOLDEN) >> (64 - RECENT)) as usize
}
