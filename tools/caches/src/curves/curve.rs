//! What fully associative LRU caches of every size fetch.

use super::TraceCounts;

/// What fully associative LRU caches of every size fetch and write back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Curve {
    /// What is the same for all sizes.
    pub trace: TraceCounts,
    /// Distinct lines, first touched by a counted access: what a cache of any size must fetch.
    pub compulsory: u64,
    /// By lines of the cache; those beyond the end are as the last.
    pub(super) fetches: Vec<u64>,
    pub(super) write_backs: Vec<u64>,
}

impl Curve {
    /// Lines fetched by a cache of so many lines.
    #[must_use]
    pub fn fetches(&self, lines: u64) -> u64 {
        at(&self.fetches, lines)
    }

    /// Lines written back by a cache of so many lines: each once for every time it turned dirty.
    #[must_use]
    pub fn write_backs(&self, lines: u64) -> u64 {
        at(&self.write_backs, lines)
    }

    /// The least size from which on nothing changes, in lines; at least 1.
    #[must_use]
    pub fn last(&self) -> u64 {
        (self.fetches.len().max(self.write_backs.len()) as u64 - 1).max(1)
    }

    /// The sizes in lines at which something changes, ascending: 1, and each whose fetches or write-backs differ from
    /// those of the cache one line smaller. A size between two of these counts what the lower one counts.
    pub fn changes(&self) -> impl Iterator<Item = u64> {
        let differs = |&lines: &u64| {
            self.fetches(lines) != self.fetches(lines - 1) || self.write_backs(lines) != self.write_backs(lines - 1)
        };
        std::iter::once(1).chain((2..=self.last()).filter(differs))
    }

    /// Where the cliff ends: the least size in lines at which the ratio of the fetches of half of it to its own is
    /// greatest. `None` if no size of at least two lines fetches less than its half.
    #[must_use]
    pub fn cliff(&self) -> Option<u64> {
        let mut cliff = None;
        let (mut above, mut below) = (1, 1);
        for lines in 2..=self.last() {
            let (half, own) = (self.fetches(lines / 2), self.fetches(lines));
            // half / own > above / below, in integers.
            if u128::from(half) * u128::from(below) > u128::from(above) * u128::from(own) {
                (above, below, cliff) = (half, own, Some(lines));
            }
        }
        cliff
    }

    /// A few sizes in lines to print: powers of two, the cliff, and the one from which on nothing changes.
    #[must_use]
    pub fn readable(&self) -> Vec<u64> {
        let mut sizes: Vec<u64> = (0..63).map(|power| 1 << power).take_while(|&lines| lines < self.last()).collect();
        sizes.extend(self.cliff());
        sizes.push(self.last());
        sizes.sort_unstable();
        sizes.dedup();
        sizes
    }
}

/// The entry for so many lines, or the last.
fn at(sums: &[u64], lines: u64) -> u64 {
    sums[(lines as usize).min(sums.len() - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RecordCounts;

    fn curve(fetches: &[u64]) -> Curve {
        let trace = TraceCounts {
            line_bytes: 64,
            queries: 2,
            records: RecordCounts::default(),
            accesses: fetches[0],
            blocks: 5,
        };
        Curve { trace, compulsory: fetches[fetches.len() - 1], fetches: fetches.to_vec(), write_backs: vec![0] }
    }

    #[test]
    fn sizes_to_print_hold_the_cliff() {
        let curve = curve(&[100, 90, 90, 90, 80, 80, 70, 7, 7, 7, 6, 5]);
        assert_eq!(curve.changes().collect::<Vec<_>>(), [1, 4, 6, 7, 10, 11]);
        assert_eq!((curve.last(), curve.cliff()), (11, Some(11)), "80 over 5 is more than 90 over 7");
        assert_eq!(curve.readable(), [1, 2, 4, 8, 11]);
        assert_eq!((curve.fetches(5), curve.fetches(11), curve.fetches(1 << 40)), (80, 5, 5));
    }

    #[test]
    fn curves_of_nothing_and_without_a_cliff() {
        for (fetches, last) in [(&[0][..], 1), (&[3, 3], 1), (&[9, 4], 1), (&[9, 4, 4], 2)] {
            let curve = curve(fetches);
            assert_eq!((curve.last(), curve.cliff()), (last, None));
            assert_eq!(curve.changes().collect::<Vec<_>>(), [1]);
        }
        assert_eq!(curve(&[9, 4, 0]).cliff(), Some(2), "everything to nothing");
    }
}
