//! The miss curve: what fully associative LRU caches of every size fetch, from one pass.
//!
//! An access of stack distance d misses in the caches of at most d lines, a first touch in all; so the fetches of a cache
//! of C lines are the counted accesses of distance C or more. Write-backs come from the same pass (Thompson and Smith,
//! *Efficient (stack) algorithms for analysis of write-back and sector memories*, ACM TOCS 7, 1989): a line is dirty in
//! the caches larger than the greatest distance it was used at since it was last written, so a write turns it dirty in
//! the others, and each of these writes it back once.

use super::{RecordCounts, lines::LineChunk, stack_distance::StackDistances};

/// How many counted events had each stack distance.
#[derive(Default)]
pub(super) struct Histogram {
    at: Vec<u64>,
    /// Those of a line never used before.
    never: u64,
}

impl Histogram {
    /// Makes room for distances below `touched`.
    #[inline]
    fn reserve(&mut self, touched: u64) {
        if self.at.len() < touched as usize {
            self.at.resize((touched + touched / 8) as usize + 64, 0);
        }
    }

    /// Counts an access, if it counts; `distances` has just told its distance.
    #[inline]
    pub(super) fn add(&mut self, distance: Option<u32>, distances: &StackDistances, counted: bool) {
        match distance {
            Some(distance) => self.at[distance as usize] += u64::from(counted),
            None => {
                self.never += u64::from(counted);
                self.reserve(distances.touched());
            }
        }
    }

    /// By lines of the cache, from none on: the events at a distance of that or more. Ends where it no longer changes.
    pub(super) fn at_least(mut self) -> Vec<u64> {
        let used = self.at.iter().rposition(|&n| n > 0).map_or(0, |last| last + 1);
        self.at.truncate(used);
        self.at.push(self.never);
        // In place: with a line for each of these numbers, they are most of the memory.
        for i in (0..used).rev() {
            self.at[i] += self.at[i + 1];
        }
        self.at
    }
}

/// Collects the curve of one line size.
pub(super) struct CurveStack {
    distances: StackDistances,
    accesses: Histogram,
    /// By slot: the greatest distance since the last counted write, [`CLEAN`] before that. Empty until there is a write.
    dirt: Vec<u32>,
    dirtied: Histogram,
}

/// Dirty in no cache.
const CLEAN: u32 = u32::MAX;

impl CurveStack {
    /// The curve of lines numbered below `slots`.
    pub(super) fn new(slots: u64) -> Self {
        let distances = StackDistances::new(slots);
        Self { distances, accesses: Histogram::default(), dirt: vec![], dirtied: Histogram::default() }
    }

    /// Runs the line accesses of `chunk`; `counted` is false during warm-up, when only the state changes.
    pub(super) fn run(&mut self, slots: u64, chunk: &LineChunk, counted: bool) {
        if chunk.writes() && self.dirt.is_empty() {
            self.dirt = vec![CLEAN; slots as usize];
        }
        // An access that repeats the one before is not in the chunk; its distance is 0.
        self.accesses.reserve(1);
        self.accesses.at[0] += if counted { chunk.accesses() - chunk.slots().len() as u64 } else { 0 };
        match self.dirt.is_empty() {
            true => self.pass::<false>(chunk, counted),
            false => self.pass::<true>(chunk, counted),
        }
    }

    fn pass<const WRITES: bool>(&mut self, chunk: &LineChunk, counted: bool) {
        for (i, &slot) in chunk.slots().iter().enumerate() {
            let distance = self.distances.touch(slot);
            self.accesses.add(distance, &self.distances, counted);
            if WRITES {
                let dirt = &mut self.dirt[slot as usize];
                *dirt = (*dirt).max(distance.unwrap_or(CLEAN));
                if counted && chunk.tag(i).writes() {
                    match std::mem::replace(dirt, 0) {
                        CLEAN => self.dirtied.never += 1,
                        // Dirty in every cache of a line or more.
                        0 => {}
                        greatest => {
                            self.dirtied.reserve(self.distances.touched());
                            self.dirtied.at[greatest as usize] += 1;
                        }
                    }
                }
            }
        }
    }

    /// The curve, given what is the same for all sizes.
    pub(super) fn finish(self, trace: TraceCounts) -> Curve {
        let compulsory = self.accesses.never;
        Curve { trace, compulsory, fetches: self.accesses.at_least(), write_backs: self.dirtied.at_least() }
    }
}

/// What a trace counts before any cache, at one line size. All counts leave warm-up out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TraceCounts {
    /// Line in bytes.
    pub line_bytes: u32,
    /// Queries answered.
    pub queries: u64,
    /// Record accesses over all regions.
    pub records: RecordCounts,
    /// Line accesses.
    pub accesses: u64,
    /// Blocks of memory: bytes of all regions over bytes of a line, rounded up.
    pub blocks: u64,
}

/// What fully associative LRU caches of every size fetch and write back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Curve {
    /// What is the same for all sizes.
    pub trace: TraceCounts,
    /// Distinct lines, first touched by a counted access: what a cache of any size must fetch.
    pub compulsory: u64,
    /// By lines of the cache; those beyond the end are as the last.
    fetches: Vec<u64>,
    write_backs: Vec<u64>,
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
