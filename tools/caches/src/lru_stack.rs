//! Fully associative LRU, of one size or of many sizes at once.
//!
//! Caches of the same line under LRU include one another: the C lines last used are in every cache of at least C lines
//! (Mattson, Gecsei, Slutz and Traiger 1970). So one stack of lines by recency serves all sizes. It is cut into *levels*:
//! the first holds what the smallest cache holds, each next one what its size adds. An access that finds its line in level
//! d misses in the d smaller caches and hits in the others.
//!
//! The usual stack is a linked list in which every hit moves its line to the front. Here a hit writes down one number, the
//! time of the line's last use. A line is in the first level if that time is not before the level's *tail*, the time of the
//! oldest line in it; only a miss has to find out which line that is. The trace itself is the list of candidates: an entry
//! of it whose time is still its line's last use stands for that line, any other is dead. The candidates of a level form a
//! queue in order of time; those of the first level are taken from the chunk in hand, live ones only, when a miss runs out
//! of them and at the end of the chunk. Every access is looked at once more there, but without a branch, and by then most
//! uses are dead and leave nothing to do.
//!
//! One stack also beats one simulator for each size: the seven in ten accesses that hit the smallest cache do nothing for
//! the larger ones, while separate simulators would look each of them up again (`cargo bench --bench cache` has both).

use super::{
    lines::{LineChunk, LineSpace},
    misses::Misses,
    model::{CacheModel, Tally},
};

/// A use of a line: its slot and when.
#[derive(Clone, Copy, Default)]
struct Use {
    slot: u32,
    time: u32,
}

/// When each slot was last used. Times start at [`FIRST_TIME`].
struct LastUse(Vec<u32>);

/// Not yet used. An explicit offset: no access happens at time 0, and slot 0 is a slot like any other.
const NEVER: u32 = 0;
/// Used long ago, and in no cache since: what is left of a time when times are numbered anew.
const GONE: u32 = 1;
/// The first access happens now.
const FIRST_TIME: u32 = 2;

impl LastUse {
    /// Whether nothing has touched the line since.
    #[inline]
    fn is(&self, u: Use) -> bool {
        self.0[u.slot as usize] == u.time
    }
}

/// Uses in order of time, oldest first, dead ones among them.
#[derive(Default)]
struct Queue {
    /// `uses[head..tail]` is the queue, the rest is free.
    uses: Vec<Use>,
    head: usize,
    tail: usize,
}

impl Queue {
    /// Makes room for `n` more, by dropping dead uses if that frees half of the space, else by growing: so each use is
    /// moved a bounded number of times, and the space stays within a small multiple of the live lines.
    #[inline]
    fn reserve(&mut self, n: usize, last: &LastUse) {
        if self.tail + n > self.uses.len() {
            self.tidy(n, last);
        }
    }

    #[cold]
    fn tidy(&mut self, n: usize, last: &LastUse) {
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
    fn push(&mut self, u: Use, last: &LastUse) {
        self.reserve(1, last);
        self.uses[self.tail] = u;
        self.tail += 1;
    }

    /// Takes out the oldest live use.
    #[inline]
    fn pop(&mut self, last: &LastUse) -> Option<Use> {
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

    fn live(&self, last: &LastUse) -> impl Iterator<Item = Use> {
        self.uses[self.head..self.tail].iter().copied().filter(|&u| last.is(u))
    }
}

/// What one size adds to the next smaller one.
struct Level {
    /// Lines it can hold.
    capacity: u64,
    /// Lines it holds.
    lines: u64,
    /// No line of the level was last used before this; while the level is not full, no line at all.
    tail: u32,
    queue: Queue,
}

impl Level {
    /// One line more: the oldest has to leave if the level is full. What it holds is all in its queue.
    #[inline]
    fn pass_down(&mut self, last: &LastUse) -> Option<Use> {
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
    fn admit(&mut self, pending: &mut Pending, now: usize, last: &LastUse) -> Option<Use> {
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
            pending.move_batch(&mut self.queue, now, last);
        }
    }
}

/// The part of the chunk in hand that no queue has seen yet.
struct Pending<'a> {
    slots: &'a [u32],
    /// Time of the first slot.
    start: u32,
    /// Index of the first slot no queue has seen.
    seen: usize,
}

/// How many uses to look at when a miss runs out of candidates: enough for the loop to be worth its start.
const BATCH: usize = 64;

impl Pending<'_> {
    /// Moves the live ones of the next few uses before index `now` to the queue.
    #[inline(never)]
    fn move_batch(&mut self, queue: &mut Queue, now: usize, last: &LastUse) {
        assert!(self.seen < now, "a full level has lines");
        self.move_to(queue, now.min(self.seen + BATCH), last);
    }

    /// Moves live uses before index `end` to the queue.
    #[inline]
    fn move_to(&mut self, queue: &mut Queue, end: usize, last: &LastUse) {
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

/// Fully associative LRU caches of one line size.
pub(super) struct LruStack {
    last: LastUse,
    levels: Vec<Level>,
    now: u32,
    /// Times stay below this; on reaching it, they are numbered anew.
    horizon: u32,
    regions: usize,
    /// Counted accesses by how many of the caches they missed in, then by region.
    missed: Vec<u64>,
    /// Counted first touches.
    compulsory: u64,
    /// Dirtiness; empty until there is a write.
    dirt: Vec<u16>,
    /// Counted writes by how many of the caches they turned the line dirty in.
    dirtied: Vec<u64>,
}

/// The most sizes one stack takes.
pub(super) const MAX_SIZES: usize = u16::MAX as usize;

impl LruStack {
    /// Caches that hold so many lines each: at least one size, at most [`MAX_SIZES`], ascending and all different.
    pub(super) fn new(space: &LineSpace, regions: usize, sizes: &[u64]) -> Self {
        assert!(!sizes.is_empty() && sizes.len() <= MAX_SIZES && sizes.is_sorted_by(|a, b| a < b) && sizes[0] > 0);
        let mut smaller = 0;
        let level = |&size: &u64| {
            let capacity = size - std::mem::replace(&mut smaller, size);
            Level { capacity, lines: 0, tail: GONE, queue: Queue::default() }
        };
        Self {
            last: LastUse(vec![NEVER; space.slots() as usize]),
            levels: sizes.iter().map(level).collect(),
            now: FIRST_TIME,
            horizon: u32::MAX,
            regions,
            missed: vec![0; (sizes.len() + 1) * regions],
            compulsory: 0,
            dirt: Vec::new(),
            dirtied: vec![0; sizes.len() + 1],
        }
    }

    /// The loop over a chunk whose times fit below the horizon.
    ///
    /// Whether there are writes, and whether there is one size only, is settled outside of the loop: that
    /// makes the most common case, reads through one cache, a quarter faster.
    fn pass<const WRITES: bool, const ONE_SIZE: bool>(
        &mut self,
        chunk: &LineChunk,
        counted: bool,
        misses: &mut Misses,
    ) {
        let slots = chunk.slots();
        let start = self.now;
        let mut pending = Pending { slots, start, seen: 0 };
        let mut tail = self.levels[0].tail;
        for (i, &slot) in slots.iter().enumerate() {
            let before = std::mem::replace(&mut self.last.0[slot as usize], start + i as u32);
            let mut depth = 0;
            if before < tail {
                if ONE_SIZE {
                    depth = 1;
                    self.levels[0].admit(&mut pending, i, &self.last);
                } else {
                    depth = depth_of(&self.levels, before);
                    make_room(&mut self.levels, depth, &mut pending, i, &self.last);
                }
                tail = self.levels[0].tail;
                misses.push(i, depth);
                self.missed[depth * self.regions + chunk.tag(i).region()] += u64::from(counted);
                self.compulsory += u64::from(counted && before == NEVER);
            }
            if WRITES {
                // The caches a line is dirty in are always the largest ones, since a fetch makes it clean in the smaller
                // and a write dirty in all: `dirt` is the number of caches it is clean or absent in.
                let dirt = &mut self.dirt[slot as usize];
                *dirt = (*dirt).max(depth as u16);
                if counted && chunk.tag(i).writes() {
                    self.dirtied[usize::from(*dirt)] += 1;
                    *dirt = 0;
                }
            }
        }
        if let Some(first) = self.levels.first_mut() {
            pending.move_to(&mut first.queue, slots.len(), &self.last);
        }
        self.now = start + slots.len() as u32;
    }

    /// Numbers the live uses from the first time on, in the same order, so that times never run out.
    #[cold]
    fn renumber(&mut self) {
        let mut live: Vec<Vec<Use>> = self.levels.iter().map(|l| l.queue.live(&self.last).collect()).collect();
        self.last.0.iter_mut().filter(|t| **t != NEVER).for_each(|t| *t = GONE);
        self.now = FIRST_TIME;
        // The deepest level is the oldest.
        for (level, uses) in self.levels.iter_mut().zip(&mut live).rev() {
            level.tail = self.now;
            for u in &mut *uses {
                u.time = self.now;
                self.last.0[u.slot as usize] = self.now;
                self.now += 1;
            }
            level.queue = Queue { head: 0, tail: uses.len(), uses: std::mem::take(uses) };
        }
    }
}

/// In which level a line last used at time `before` is; the number of levels if in none.
#[inline]
fn depth_of(levels: &[Level], before: u32) -> usize {
    1 + levels[1..].iter().take_while(|level| before < level.tail).count()
}

/// Makes room in the first level for the access at index `now`: each level above `depth` passes its oldest line down.
fn make_room(levels: &mut [Level], depth: usize, pending: &mut Pending, now: usize, last: &LastUse) {
    let Some((first, others)) = levels.split_first_mut() else { return };
    let mut from_above = first.admit(pending, now, last);
    for level in &mut others[..depth - 1] {
        let Some(u) = from_above else { return };
        level.queue.push(u, last);
        from_above = level.pass_down(last);
    }
    if let (Some(u), Some(level)) = (from_above, others.get_mut(depth - 1)) {
        level.queue.push(u, last);
    }
}

impl CacheModel for LruStack {
    fn run(&mut self, _: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses) {
        if (self.horizon - self.now) as usize <= chunk.slots().len() {
            self.renumber();
        }
        if chunk.writes() && self.dirt.is_empty() {
            self.dirt = vec![self.levels.len() as u16; self.last.0.len()];
        }
        // A trace without writes, which most are, never looks at dirtiness.
        match (self.dirt.is_empty(), self.levels.len() == 1) {
            (true, true) => self.pass::<false, true>(chunk, counted, misses),
            (true, false) => self.pass::<false, false>(chunk, counted, misses),
            (false, true) => self.pass::<true, true>(chunk, counted, misses),
            (false, false) => self.pass::<true, false>(chunk, counted, misses),
        }
    }

    fn finish(self: Box<Self>) -> Vec<Tally> {
        let size = |i: usize| {
            let mut tally = Tally { fetches: vec![0; self.regions], compulsory: self.compulsory, write_backs: 0 };
            // Size i misses what more than i sizes missed.
            for missed in self.missed.chunks(self.regions.max(1)).skip(i + 1) {
                tally.fetches.iter_mut().zip(missed).for_each(|(sum, n)| *sum += n);
            }
            tally.write_backs = self.dirtied[i + 1..].iter().sum();
            tally
        };
        (0..self.levels.len()).map(size).collect()
    }
}

#[cfg(test)]
mod tests {
    use pm_formats::trace::{Access, AccessKind, Coding, lay_out};

    use super::super::{lines::Cursor, records::Records};
    use super::*;

    /// Runs pseudo-random accesses to 60 lines, one in five a write, through caches of 1, 4 and 30 lines.
    fn tallies(horizon: u32) -> Vec<Tally> {
        let regions = lay_out([("a".to_owned(), 60 * 64, 64, Coding::Records)]);
        let space = LineSpace::new(&regions, 64);
        let mut stack = Box::new(LruStack::new(&space, 1, &[1, 4, 30]));
        stack.horizon = horizon;
        let mut chunk = LineChunk::default();
        let mut state = 1_u32;
        for round in 0..500 {
            let mut records = Records::new(40);
            for _ in 0..40 {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let line = (state >> 16) % if round % 50 < 25 { 60 } else { 6 };
                let kind = if state >> 29 == 0 { AccessKind::Write } else { AccessKind::Read };
                records.push(&Access { kind, region: 0, len: 4, offset: u64::from(line) * 64 });
            }
            chunk.split(&space, &records.batch(), &mut Cursor::default());
            stack.run(&space, &chunk, round != 7, &mut Misses::default());
        }
        stack.finish()
    }

    #[test]
    fn times_that_run_out_are_numbered_anew() {
        let expected = tallies(u32::MAX);
        assert!(expected.iter().all(|tally| tally.fetches[0] > 0 && tally.write_backs > 0));
        for horizon in [73, 100, 1001] {
            assert_eq!(tallies(horizon), expected, "horizon {horizon}");
        }
    }
}
