//! Working sets: how many distinct lines a search touches, and how many a batch.

use super::Distribution;
use crate::lines::LineChunk;

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
///
/// A batch is a run of searches, so the last search that touched a line tells whether its batch has touched it.
pub(crate) struct WorkingSetCounter {
    /// By slot: the last search that touched it; 0 before the first.
    last: Vec<u32>,
    /// The search that is open, numbered from 1; 0 before the first.
    search: u32,
    /// The first search of the batch that is open.
    first_of_batch: u32,
    /// The batch that is open.
    batch_id: u64,
    /// Distinct lines of the search that is open, and of the batch.
    of_search: u32,
    of_batch: u32,
    /// The greatest number of a search: then they begin anew.
    most: u32,
    sets: WorkingSets,
}

impl WorkingSetCounter {
    pub(crate) fn new(slots: u64) -> Self {
        Self {
            last: vec![0; slots as usize],
            search: 0,
            first_of_batch: 0,
            batch_id: 0,
            of_search: 0,
            of_batch: 0,
            most: u32::MAX,
            sets: WorkingSets::default(),
        }
    }

    /// Counts the lines of a chunk that knows where searches begin. Those before the first belong to the search that began
    /// before.
    pub(crate) fn run(&mut self, chunk: &LineChunk) {
        let (slots, mut from) = (chunk.slots(), 0);
        for start in chunk.starts() {
            self.touch(&slots[from..start.at]);
            self.begin(start.batch);
            from = start.at;
        }
        self.touch(&slots[from..]);
    }

    fn begin(&mut self, batch: u64) {
        self.end_search();
        if self.search == self.most {
            self.number_anew();
        }
        self.search += 1;
        self.of_search = 0;
        if self.first_of_batch == 0 || self.batch_id != batch {
            self.end_batch();
            (self.first_of_batch, self.batch_id, self.of_batch) = (self.search, batch, 0);
        }
    }

    /// When numbers run out, what lines have to know is whether the batch that is open has touched them: as if by its first
    /// search, and that is the first of all.
    #[cold]
    fn number_anew(&mut self) {
        self.last.iter_mut().for_each(|last| *last = u32::from(*last >= self.first_of_batch));
        (self.search, self.first_of_batch) = (1, 1);
    }

    /// Whether a search comes back to a line depends on the data, so it is arithmetic and not a branch; and both sums are halves
    /// of one number, since compilers make a vector of two, which takes twice as long.
    fn touch(&mut self, slots: &[u32]) {
        // Before the first search there is nothing to count for.
        if self.search == 0 {
            return;
        }
        let (search, first_of_batch) = (self.search, self.first_of_batch);
        let mut sums = 0;
        for &slot in slots {
            let last = std::mem::replace(&mut self.last[slot as usize], search);
            sums += u64::from(last < search) + (u64::from(last < first_of_batch) << 32);
        }
        self.of_search += sums as u32;
        self.of_batch += (sums >> 32) as u32;
    }

    fn end_search(&mut self) {
        if self.search > 0 {
            self.sets.per_search.add(self.of_search);
        }
    }

    fn end_batch(&mut self) {
        if self.first_of_batch > 0 {
            self.sets.per_batch.add(self.of_batch);
        }
    }

    pub(crate) fn finish(mut self) -> WorkingSets {
        self.end_search();
        self.end_batch();
        self.sets
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::{AccessBuffer, LineSpace, Resume, SearchStart};
    use pm_formats::trace::{Access, Coding, lay_out};
    use pm_random::Random;
    use std::collections::BTreeSet;

    #[test]
    fn numbers_of_searches_that_run_out_change_nothing() {
        let space = LineSpace::new(&lay_out([("photons".to_owned(), 1024, 20, Coding::Records)]), 64);
        for most in [2, 3, 10, u32::MAX] {
            let (mut random, mut chunk) = (Random::new(&[5]), LineChunk::default());
            let mut counter = WorkingSetCounter { most, ..WorkingSetCounter::new(space.slots()) };
            let (mut expected, mut of_batch, mut open) = (WorkingSets::default(), BTreeSet::new(), None);
            for search in 0..500_u64 {
                // Batches of one search, and of more than there are numbers.
                let batch = if search < 250 { search / 25 } else { search * search / 100 };
                if open.is_some_and(|open| open != batch) {
                    expected.per_batch.add(std::mem::take(&mut of_batch).len() as u32);
                }
                open = Some(batch);
                let mut records = AccessBuffer::new(8);
                let mut of_search = BTreeSet::new();
                for _ in 0..random.next_u64() % 8 {
                    let offset = random.next_u64() % 51 * 20;
                    assert!(records.push(&Access::read(0, offset, 20)));
                    of_search.extend(offset / 64..=(offset + 19) / 64);
                }
                expected.per_search.add(of_search.len() as u32);
                of_batch.append(&mut of_search);
                let mut resume = Resume::default();
                while chunk.split(&space, &records.waiting(), &[SearchStart { at: 0, batch }], &mut resume) {
                    counter.run(&chunk);
                }
            }
            expected.per_batch.add(of_batch.len() as u32);
            assert_eq!(counter.finish(), expected, "{most} numbers");
        }
    }
}
