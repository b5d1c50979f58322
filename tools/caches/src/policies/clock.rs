//! Evicts the first line in a round that was not used since the hand last passed it.

use std::collections::{BTreeMap, BTreeSet};

use super::Policy;
use crate::models::{CacheModel, CacheOnTrace, Replacement};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// The first line in a round that was not used since the hand last passed it: second chance (Corbató 1969)
    pub(crate) struct Clock = "clock";
}

impl Policy for Clock {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Hands::new(cache.sets(), cache.ways()))
    }
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(Rounds::default())
    }
}

/// A hand for each set, and for each way whether its line was used since the hand passed.
///
/// A line that comes in counts as used: in the machines the policy was made for (Corbató, *A Paging Experiment with the
/// Multics System*, 1969) the access that failed is made again. Each step of the hand undoes one use, so an access costs
/// one step on average whatever the number of ways.
struct Hands {
    used: Vec<bool>,
    hands: Vec<u32>,
    ways: usize,
}

impl Hands {
    fn new(sets: usize, ways: usize) -> Self {
        Self { used: vec![false; sets * ways], hands: vec![0; sets], ways }
    }
}

impl Replacement for Hands {
    const REPEATS_MATTER: bool = false;

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

/// The definition: by set, where the hand is, and the ways used since it passed them.
#[derive(Default)]
struct Rounds(BTreeMap<u64, (usize, BTreeSet<usize>)>);

impl Definition for Rounds {
    fn used(&mut self, set: u64, way: usize) {
        self.0.entry(set).or_default().1.insert(way);
    }

    fn victim(&mut self, full: &FullSet) -> Option<usize> {
        let (hand, used) = self.0.entry(full.set()).or_default();
        loop {
            let way = *hand;
            *hand = (*hand + 1) % full.held().len();
            if !used.remove(&way) {
                return Some(way);
            }
        }
    }
}
