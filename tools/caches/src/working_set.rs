//! Working sets: how many distinct lines a search touches, and how many a batch.

use std::collections::BTreeMap;

use super::{lines::LineSpace, records::Batch};

/// Where a search that counts begins among the accesses that wait.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    /// Index of its first access.
    pub(super) at: usize,
    /// The batch it belongs to.
    pub(super) batch: u64,
}

/// How a count is distributed over the searches or batches of a trace.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Distribution {
    /// Searches or batches by their count.
    numbers: BTreeMap<u32, u64>,
}

impl Distribution {
    fn add(&mut self, count: u32) {
        *self.numbers.entry(count).or_default() += 1;
    }

    /// How many searches or batches.
    #[must_use]
    pub fn number(&self) -> u64 {
        self.numbers.values().sum()
    }

    /// Sum of all counts.
    #[must_use]
    pub fn sum(&self) -> u64 {
        self.numbers.iter().map(|(&count, number)| u64::from(count) * number).sum()
    }

    /// Mean count; not a number if there is none.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.sum() as f64 / self.number() as f64
    }

    /// The least count that `percent` percent do not exceed (nearest rank); `None` if there is none.
    #[must_use]
    pub fn percentile(&self, percent: u64) -> Option<u32> {
        let rank = (u128::from(self.number()) * u128::from(percent)).div_ceil(100).max(1);
        let mut seen = 0;
        self.numbers
            .iter()
            .find(|&(_, &number)| {
                seen += u128::from(number);
                seen >= rank
            })
            .map(|(&count, _)| count)
    }

    /// The greatest count.
    #[must_use]
    pub fn max(&self) -> Option<u32> {
        self.numbers.last_key_value().map(|(&count, _)| count)
    }
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
pub(super) struct WorkingSetCounter {
    /// By slot: the last search and the last batch that touched it, numbered from 1.
    last: Vec<[u32; 2]>,
    search: Stage,
    batch: Stage,
    /// The batch that is open.
    batch_id: u64,
    sets: WorkingSets,
}

/// A search or a batch that goes on.
#[derive(Default)]
struct Stage {
    /// Its number; 0 before the first.
    number: u32,
    lines: u32,
}

impl WorkingSetCounter {
    pub(super) fn new(slots: u64) -> Self {
        Self {
            last: vec![[0; 2]; slots as usize],
            search: Stage::default(),
            batch: Stage::default(),
            batch_id: 0,
            sets: WorkingSets::default(),
        }
    }

    /// Counts the lines of accesses among which searches begin at `marks`. Those before the first belong to the search
    /// that began before.
    pub(super) fn run(&mut self, space: &LineSpace, accesses: &Batch, marks: &[Mark]) {
        let mut from = 0;
        for mark in marks {
            self.touch(space, accesses, from..mark.at);
            self.begin(mark.batch);
            from = mark.at;
        }
        self.touch(space, accesses, from..accesses.shapes.len());
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
        let stage = if which == 0 { &mut self.search } else { &mut self.batch };
        if stage.number == u32::MAX {
            self.last.iter_mut().for_each(|last| last[which] = 0);
            stage.number = 0;
        }
        *stage = Stage { number: stage.number + 1, lines: 0 };
    }

    #[inline]
    fn touch(&mut self, space: &LineSpace, accesses: &Batch, range: std::ops::Range<usize>) {
        // Before the first search there is nothing to count for.
        if self.search.number == 0 {
            return;
        }
        for (&offset, &shape) in accesses.offsets[range.clone()].iter().zip(&accesses.shapes[range]) {
            let (first, end) = space.ends(offset, shape);
            for slot in first..=end {
                let last = &mut self.last[slot as usize];
                if last[0] != self.search.number {
                    last[0] = self.search.number;
                    self.search.lines += 1;
                    self.batch.lines += u32::from(last[1] != self.batch.number);
                    last[1] = self.batch.number;
                }
            }
        }
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

    pub(super) fn finish(mut self) -> WorkingSets {
        self.end_search();
        self.end_batch();
        self.sets
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_nearest_ranks() {
        let mut distribution = Distribution::default();
        assert_eq!((distribution.percentile(50), distribution.max(), distribution.number()), (None, None, 0));
        assert!(distribution.mean().is_nan());
        for count in [15, 20, 35, 40, 50] {
            distribution.add(count);
        }
        // The textbook's example of the nearest-rank method.
        let ranks = [5, 30, 40, 50, 100].map(|percent| distribution.percentile(percent).unwrap());
        assert_eq!(ranks, [15, 20, 20, 35, 50]);
        assert_eq!((distribution.sum(), distribution.mean(), distribution.max()), (160, 32.0, Some(50)));
    }
}
