//! How many accesses had each stack distance.

use super::StackDistances;

/// How many counted events had each stack distance.
#[derive(Default)]
pub(super) struct Histogram {
    pub(super) at: Vec<u64>,
    /// Those of a line never used before.
    pub(super) never: u64,
}

impl Histogram {
    /// Makes room for distances below `touched`.
    #[inline]
    pub(super) fn reserve(&mut self, touched: u64) {
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
