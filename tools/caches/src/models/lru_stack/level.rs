//! What one size of cache adds to the next smaller one.

use super::pending::Pending;
use super::queue::{Queue, Use};
use super::times::Times;

/// What one size adds to the next smaller one.
pub(super) struct Level {
    /// Lines it can hold.
    pub(super) capacity: u64,
    /// Lines it holds.
    pub(super) lines: u64,
    /// No line of the level was last used before this; while the level is not full, no line at all.
    pub(super) tail: u32,
    pub(super) queue: Queue,
}

impl Level {
    /// One line more: the oldest has to leave if the level is full. What it holds is all in its queue.
    #[inline]
    pub(super) fn pass_down(&mut self, last: &impl Times) -> Option<Use> {
        if self.lines < self.capacity {
            self.lines += 1;
            return None;
        }
        let oldest = self.queue.pop(last)?;
        self.tail = oldest.time + 1;
        Some(oldest)
    }

    /// The same for the first level, part of whose lines are in what is pending before index `now`.
    #[inline]
    pub(super) fn admit(&mut self, pending: &mut Pending, now: usize, last: &impl Times) -> Option<Use> {
        if self.lines < self.capacity {
            self.lines += 1;
            return None;
        }
        loop {
            if let Some(oldest) = self.queue.pop(last) {
                self.tail = oldest.time + 1;
                return Some(oldest);
            }
            // It is full, so one of its lines was last used in what is pending if none is queued.
            pending.move_some(&mut self.queue, now, last);
        }
    }
}

/// In which level a line last used at time `before` is; the number of levels if in none.
#[inline]
pub(super) fn depth_of(levels: &[Level], before: u32) -> usize {
    1 + levels[1..].iter().take_while(|level| before < level.tail).count()
}

/// Makes room in the first level for the access at index `now`: each level above `depth` passes its oldest line down. What
/// leaves the last level is in no cache any more.
pub(super) fn make_room(
    levels: &mut [Level],
    depth: usize,
    pending: &mut Pending,
    now: usize,
    last: &impl Times,
) -> Option<Use> {
    let (first, others) = levels.split_first_mut()?;
    let mut from_above = first.admit(pending, now, last);
    for level in &mut others[..depth - 1] {
        level.queue.push(from_above?, last);
        from_above = level.pass_down(last);
    }
    match others.get_mut(depth - 1) {
        Some(level) => {
            level.queue.push(from_above?, last);
            None
        }
        None => from_above,
    }
}
