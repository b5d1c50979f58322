//! Evicts the first line in a round that was not used since the hand last passed it.

use super::Replacement;

/// A hand for each set, and for each way whether its line was used since the hand passed.
///
/// A line that comes in counts as used: in the machines the policy was made for (Corbató, *A Paging Experiment with the
/// Multics System*, 1969) the access that failed is made again. Each step of the hand undoes one use, so an access costs
/// one step on average whatever the number of ways.
pub(in super::super) struct Clock {
    used: Vec<bool>,
    hands: Vec<u32>,
    ways: usize,
}

impl Clock {
    pub(in super::super) fn new(sets: usize, ways: usize) -> Self {
        Self { used: vec![false; sets * ways], hands: vec![0; sets], ways }
    }
}

impl Replacement for Clock {
    #[inline]
    fn hit(&mut self, set: usize, way: usize) {
        self.used[set * self.ways + way] = true;
    }

    #[inline]
    fn fill(&mut self, set: usize, way: usize) {
        self.hit(set, way);
    }

    #[inline]
    fn victim(&mut self, set: usize) -> usize {
        let used = &mut self.used[set * self.ways..][..self.ways];
        let mut hand = self.hands[set] as usize;
        loop {
            let victim = hand;
            hand = if hand + 1 == used.len() { 0 } else { hand + 1 };
            if !std::mem::replace(&mut used[victim], false) {
                self.hands[set] = hand as u32;
                return victim;
            }
        }
    }
}
