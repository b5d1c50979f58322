//! The part of the chunk in hand that the levels have not seen.

use super::queue::{Queue, Use};
use super::times::Times;

/// The part of the chunk in hand that no queue has seen yet.
pub(super) struct Pending<'a> {
    pub(super) slots: &'a [u32],
    /// Time of the first slot.
    pub(super) start: u32,
    /// Index of the first slot no queue has seen.
    pub(super) seen: usize,
}

/// How many uses to look at when a miss runs out of candidates: enough for the loop to be worth its start.
const STEP: usize = 64;

impl Pending<'_> {
    /// Moves the live ones of the next few uses before index `now` to the queue.
    #[inline(never)]
    pub(super) fn move_some(&mut self, queue: &mut Queue, now: usize, last: &impl Times) {
        assert!(self.seen < now, "a full level has lines");
        self.move_to(queue, now.min(self.seen + STEP), last);
    }

    /// Moves live uses before index `end` to the queue.
    #[inline]
    pub(super) fn move_to(&mut self, queue: &mut Queue, end: usize, last: &impl Times) {
        let slots = &self.slots[self.seen..end];
        queue.reserve(slots.len(), last);
        let time = self.start + self.seen as u32;
        let free = &mut queue.uses[queue.tail..][..slots.len()];
        let mut kept = 0;
        // Which uses are live is anyone's guess, so it is arithmetic and not a branch.
        for (i, &slot) in slots.iter().enumerate() {
            let u = Use { slot, time: time + i as u32 };
            free[kept] = u;
            kept += usize::from(last.is(u));
        }
        queue.tail += kept;
        self.seen = end;
    }
}
