//! Uses of lines in order of time: the candidates of a level.

use super::times::Times;

/// A use of a line: its slot and when.
#[derive(Clone, Copy, Default)]
pub(super) struct Use {
    pub(super) slot: u32,
    pub(super) time: u32,
}

/// Not yet used. An explicit offset: no access happens at time 0, and slot 0 is a slot like any other.
pub(super) const NEVER: u32 = 0;
/// Used long ago, and in no cache since: what is left of a time when times are numbered anew.
pub(super) const GONE: u32 = 1;
/// The first access happens now.
pub(super) const FIRST_TIME: u32 = 2;

/// Uses in order of time, oldest first, dead ones among them.
#[derive(Default)]
pub(super) struct Queue {
    /// `uses[head..tail]` is the queue, the rest is free.
    pub(super) uses: Vec<Use>,
    pub(super) head: usize,
    pub(super) tail: usize,
}

impl Queue {
    /// Makes room for `n` more, by dropping dead uses if that frees half of the space, else by growing: so each use is
    /// moved a bounded number of times, and the space stays within a small multiple of the live lines.
    #[inline]
    pub(super) fn reserve(&mut self, n: usize, last: &impl Times) {
        if self.tail + n > self.uses.len() {
            self.tidy(n, last);
        }
    }

    #[cold]
    fn tidy(&mut self, n: usize, last: &impl Times) {
        let mut kept = 0;
        for i in self.head..self.tail {
            let u = self.uses[i];
            self.uses[kept] = u;
            kept += usize::from(last.is(u));
        }
        (self.head, self.tail) = (0, kept);
        if kept + n > self.uses.len() / 2 {
            self.uses.resize(2 * (kept + n), Use::default());
        }
    }

    #[inline]
    pub(super) fn push(&mut self, u: Use, last: &impl Times) {
        self.reserve(1, last);
        self.uses[self.tail] = u;
        self.tail += 1;
    }

    /// Takes out the oldest live use.
    #[inline]
    pub(super) fn pop(&mut self, last: &impl Times) -> Option<Use> {
        while self.head < self.tail {
            let u = self.uses[self.head];
            self.head += 1;
            if last.is(u) {
                return Some(u);
            }
        }
        // Start over at the front: a queue that runs empty now and then never needs tidying.
        (self.head, self.tail) = (0, 0);
        None
    }

    pub(super) fn live(&self, last: &impl Times) -> impl Iterator<Item = Use> {
        self.uses[self.head..self.tail].iter().copied().filter(|&u| last.is(u))
    }
}
