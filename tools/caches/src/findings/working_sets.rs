//! Working sets: how many distinct lines a search touches, and how many a batch.

use super::Distribution;
use crate::lines::{Accesses, LineSpace, Shapes};

/// Where a search that counts begins among the accesses that wait.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SearchStart {
    /// Index of its first access.
    pub(crate) at: usize,
    /// The batch it belongs to.
    pub(crate) batch: u64,
}

/// Distinct lines of one size. Warm-up is left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WorkingSets {
    /// Distinct lines of each search: the working set of a query, or of those that one search serves.
    pub per_search: Distribution,
    /// Distinct lines of each batch, a run of blocks of the same batch. Their sum is what must be fetched by a cache that
    /// begins each batch empty, however large: the floor of every order within batches.
    pub per_batch: Distribution,
}

/// Counts them.
pub(crate) struct WorkingSetCounter {
    /// By slot: the last search and the last batch that touched it, numbered from 1.
    last: Vec<[u32; 2]>,
    search: OpenSet,
    batch: OpenSet,
    /// The batch that is open.
    batch_id: u64,
    sets: WorkingSets,
}

/// A search or a batch that goes on.
#[derive(Default)]
struct OpenSet {
    /// Its number; 0 before the first.
    number: u32,
    lines: u32,
}

impl WorkingSetCounter {
    pub(crate) fn new(slots: u64) -> Self {
        Self {
            last: vec![[0; 2]; slots as usize],
            search: OpenSet::default(),
            batch: OpenSet::default(),
            batch_id: 0,
            sets: WorkingSets::default(),
        }
    }

    /// Counts the lines of accesses among which searches begin at `starts`. Those before the first belong to the search
    /// that began before.
    pub(crate) fn run(&mut self, space: &LineSpace, accesses: &Accesses, starts: &[SearchStart]) {
        let mut from = 0;
        for start in starts {
            self.touch(space, accesses, from..start.at);
            self.begin(start.batch);
            from = start.at;
        }
        self.touch(space, accesses, from..accesses.len());
    }

    fn begin(&mut self, batch: u64) {
        self.end_search();
        if self.batch.number == 0 || self.batch_id != batch {
            self.end_batch();
            self.batch_id = batch;
            self.next(1);
        }
        self.next(0);
    }

    /// The next number of a search (0) or a batch (1). When numbers run out all lines forget theirs.
    fn next(&mut self, which: usize) {
        let open = if which == 0 { &mut self.search } else { &mut self.batch };
        if open.number == u32::MAX {
            self.last.iter_mut().for_each(|last| last[which] = 0);
            open.number = 0;
        }
        *open = OpenSet { number: open.number + 1, lines: 0 };
    }

    #[inline]
    fn touch(&mut self, space: &LineSpace, accesses: &Accesses, range: std::ops::Range<usize>) {
        // Before the first search there is nothing to count for.
        if self.search.number == 0 {
            return;
        }
        let offsets = accesses.offsets[range.clone()].iter();
        match accesses.shapes {
            Shapes::Alike(shape) => {
                let ends = space.ends_of(shape);
                offsets.for_each(|&offset| self.touch_lines(ends(offset)));
            }
            Shapes::Each(shapes) => {
                offsets.zip(&shapes[range]).for_each(|(&offset, &shape)| self.touch_lines(space.ends(offset, shape)));
            }
        }
    }

    /// A record from the one line to the other is read.
    #[inline(always)]
    fn touch_lines(&mut self, (first, end): (u32, u32)) {
        self.touch_line(first);
        // Most records lie in one line, or in two: the same line twice counts once.
        self.touch_line(end);
        if end > first + 1 {
            (first + 1..end).for_each(|slot| self.touch_line(slot));
        }
    }

    /// Whether a search comes back to a line depends on the data, so it is arithmetic and not a branch. A line that the search
    /// has touched, its batch has touched too.
    #[inline(always)]
    fn touch_line(&mut self, slot: u32) {
        let last = &mut self.last[slot as usize];
        self.search.lines += u32::from(last[0] != self.search.number);
        self.batch.lines += u32::from(last[1] != self.batch.number);
        *last = [self.search.number, self.batch.number];
    }

    fn end_search(&mut self) {
        if self.search.number > 0 {
            self.sets.per_search.add(self.search.lines);
        }
    }

    fn end_batch(&mut self) {
        if self.batch.number > 0 {
            self.sets.per_batch.add(self.batch.lines);
        }
    }

    pub(crate) fn finish(mut self) -> WorkingSets {
        self.end_search();
        self.end_batch();
        self.sets
    }
}
