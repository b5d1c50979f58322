//! When lines were last used: of all lines, or of those whose pages caches hold lines of.

use super::queue::{GONE, NEVER, Use};
use crate::lines::{LineSpace, grow};

/// When the line of each slot was last used.
pub(super) trait Times {
    /// Of the slots that there are now.
    fn new(space: &LineSpace) -> Self;

    /// Makes room for the slots that there are now.
    fn grow(&mut self, space: &LineSpace);

    /// These lines will be used in a moment: so memory may begin to bring what is known of them.
    fn ahead(&self, _slots: &[u32]) {}

    /// The line is used at this time: when was it before?
    fn replace(&mut self, slot: u32, time: u32) -> u32;

    /// When it was last used.
    fn of(&self, slot: u32) -> u32;

    /// A line comes into the largest cache, by the use that was told last, and before which it was used at that time: is it for
    /// the first time?
    fn comes(&mut self, slot: u32, before: u32) -> bool;

    /// A line leaves the largest cache: what matters from now on is only that it was used once.
    fn leaves(&mut self, slot: u32);

    /// All uses so far are long ago.
    fn forget(&mut self);

    /// Where in a table beside this one the line has its entry from when it comes until it leaves.
    fn place(&self, slot: u32) -> usize;

    /// Entries of such a table.
    fn places(&self) -> usize;

    /// Whether nothing has touched the line since.
    #[inline]
    fn is(&self, u: Use) -> bool {
        self.of(u.slot) == u.time
    }
}

/// Of all lines.
pub(super) struct OfLines(pub(super) Vec<u32>);

impl Times for OfLines {
    fn new(space: &LineSpace) -> Self {
        Self(vec![NEVER; space.slots() as usize])
    }

    fn grow(&mut self, space: &LineSpace) {
        grow(&mut self.0, space, NEVER);
    }

    #[inline]
    fn replace(&mut self, slot: u32, time: u32) -> u32 {
        std::mem::replace(&mut self.0[slot as usize], time)
    }

    #[inline]
    fn of(&self, slot: u32) -> u32 {
        self.0[slot as usize]
    }

    #[inline]
    fn comes(&mut self, _: u32, before: u32) -> bool {
        before == NEVER
    }

    #[inline]
    fn leaves(&mut self, _: u32) {}

    fn forget(&mut self) {
        self.0.iter_mut().filter(|time| **time != NEVER).for_each(|time| *time = GONE);
    }

    #[inline]
    fn place(&self, slot: u32) -> usize {
        slot as usize
    }

    fn places(&self) -> usize {
        self.0.len()
    }
}

/// Of the lines of those pages alone that the largest cache holds lines of. A trace of all addresses may touch one line in each
/// of a million pages: a time for each line would be most of the memory, and out of reach of the host's caches.
pub(super) struct OfPages {
    /// log2 of the lines of a page.
    shift: u32,
    /// By page: the frame that has the times of its lines, or none.
    frames: Vec<u32>,
    /// By slot, a bit each: whether the line ever came.
    came: Vec<u32>,
    /// By frame, the times of the lines of a page.
    times: Vec<u32>,
    /// By frame: how many of them the largest cache holds.
    held: Vec<u32>,
    /// Frames without a page.
    free: Vec<u32>,
}

/// Not a frame.
const NONE: u32 = u32::MAX;
/// Pages whose tables a core's own cache holds, so that there is nothing to wait for.
const FEW_PAGES: usize = 1 << 16;
/// Slots to a number of `came`.
const BITS: usize = u32::BITS as usize;

impl OfPages {
    /// Those of all lines that the largest cache holds: used at its tail or after it.
    pub(super) fn of_held(lines: &OfLines, tail: u32, space: &LineSpace) -> Self {
        let mut all = Self::new(space);
        for (page, of_page) in lines.0.chunks(1 << all.shift).enumerate() {
            for (line, _) in of_page.iter().enumerate().filter(|(_, time)| **time != NEVER) {
                let slot = page << all.shift | line;
                all.came[slot / BITS] |= 1 << (slot % BITS);
            }
            let held = of_page.iter().filter(|time| **time >= tail).count();
            if held > 0 {
                let begin = all.enter(page);
                all.times[begin..][..of_page.len()].copy_from_slice(of_page);
                all.held[begin >> all.shift] = held as u32;
            }
        }
        all
    }

    /// Slots that have a place: those of pages that have a frame.
    pub(super) fn placed(&self) -> impl Iterator<Item = u32> {
        let framed = self.frames.iter().enumerate().filter(|(_, frame)| **frame != NONE);
        framed.flat_map(|(page, _)| (page << self.shift) as u32..((page + 1) << self.shift) as u32)
    }

    /// Gives a page a frame; where that begins in the table.
    ///
    /// What was written there for another page stays. A frame is free when the lines of its page have left the largest cache, so
    /// these times are before its tail, as if those of the new page had been used then, and no use in a queue has them.
    #[inline]
    fn enter(&mut self, page: usize) -> usize {
        let frame = self.free.pop().unwrap_or_else(|| self.add());
        self.frames[page] = frame;
        (frame as usize) << self.shift
    }

    /// One frame more.
    #[cold]
    fn add(&mut self) -> u32 {
        self.times.resize(self.times.len() + (1 << self.shift), NEVER);
        self.held.push(0);
        self.held.len() as u32 - 1
    }

    /// The line in its page.
    #[inline]
    fn in_page(&self, slot: u32) -> usize {
        slot as usize & ((1 << self.shift) - 1)
    }
}

impl Times for OfPages {
    fn new(space: &LineSpace) -> Self {
        let shift = space.page_lines().ilog2();
        let mut times = Self { shift, frames: vec![], came: vec![], times: vec![], held: vec![], free: vec![] };
        times.grow(space);
        times
    }

    fn grow(&mut self, space: &LineSpace) {
        let slots = space.slots() as usize;
        self.frames.resize(slots >> self.shift, NONE);
        self.came.resize(slots.div_ceil(BITS), 0);
    }

    fn ahead(&self, slots: &[u32]) {
        if self.frames.len() > FEW_PAGES {
            let numbers =
                slots.iter().map(|&slot| self.frames[(slot >> self.shift) as usize] ^ self.came[slot as usize / BITS]);
            std::hint::black_box(numbers.fold(0, |all, number| all ^ number));
        }
    }

    #[inline]
    fn replace(&mut self, slot: u32, time: u32) -> u32 {
        let page = (slot >> self.shift) as usize;
        let begin = match self.frames[page] {
            NONE => self.enter(page),
            frame => (frame as usize) << self.shift,
        };
        let at = begin | self.in_page(slot);
        std::mem::replace(&mut self.times[at], time)
    }

    #[inline]
    fn of(&self, slot: u32) -> u32 {
        match self.frames[(slot >> self.shift) as usize] {
            NONE => NEVER,
            _ => self.times[self.place(slot)],
        }
    }

    #[inline]
    fn comes(&mut self, slot: u32, _: u32) -> bool {
        self.held[self.frames[(slot >> self.shift) as usize] as usize] += 1;
        let (came, bit) = (&mut self.came[slot as usize / BITS], 1 << (slot as usize % BITS));
        let first = *came & bit == 0;
        *came |= bit;
        first
    }

    #[inline]
    fn leaves(&mut self, slot: u32) {
        let frame = &mut self.frames[(slot >> self.shift) as usize];
        let held = &mut self.held[*frame as usize];
        *held -= 1;
        if *held == 0 {
            self.free.push(std::mem::replace(frame, NONE));
        }
    }

    fn forget(&mut self) {
        self.times.iter_mut().filter(|time| **time != NEVER).for_each(|time| *time = GONE);
    }

    #[inline]
    fn place(&self, slot: u32) -> usize {
        (self.frames[(slot >> self.shift) as usize] as usize) << self.shift | self.in_page(slot)
    }

    fn places(&self) -> usize {
        self.times.len()
    }
}
