//! Evicts the first line in a round that was not used since the hand last passed it.

use std::collections::{BTreeMap, BTreeSet};

use super::Policy;
use crate::models::{CacheModel, CacheOnTrace, Replacement};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// The first line in a round that was not used since the hand last passed it: second chance (Corbató 1969)
    pub(crate) struct Clock = "clock";
}

pm_registry::registered! {
    /// The same where a line that comes in counts as unused until it is used again, as libCacheSim has it
    pub(crate) struct ClockClear = "clock-clear";
}

impl Policy for Clock {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Hands::<true>::new(cache.sets(), cache.ways()))
    }
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(Rounds::default())
    }
}

impl Policy for ClockClear {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Hands::<false>::new(cache.sets(), cache.ways()))
    }
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(Passes::default())
    }
}

/// A hand for each set, and for each way whether its line was used since the hand passed.
///
/// A line that comes in counts as used if `SET`: in the machines the policy was made for (Corbató, *A Paging Experiment with the
/// Multics System*, 1969) the access that failed is made again. In
/// most simulators it does not. Each step of the hand undoes one use, so an access costs
/// one step on average whatever the number of ways.
struct Hands<const SET: bool> {
    used: Vec<bool>,
    hands: Vec<u32>,
    ways: usize,
}

impl<const SET: bool> Hands<SET> {
    fn new(sets: usize, ways: usize) -> Self {
        Self { used: vec![false; sets * ways], hands: vec![0; sets], ways }
    }
}

impl<const SET: bool> Replacement for Hands<SET> {
    // A line that came in unused is used where it is used at once.
    const REPEATS_MATTER: bool = !SET;

    #[inline]
    fn hit(&mut self, set: usize, way: usize) {
        self.used[set * self.ways + way] = true;
    }

    #[inline]
    fn fill(&mut self, set: usize, way: usize) {
        self.used[set * self.ways + way] = SET;
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

/// The definition of the other: by set, where the hand is, and by way when it passed. A line was used since if it was used
/// after that, when it came in not being one.
#[derive(Default)]
struct Passes(BTreeMap<u64, (usize, BTreeMap<usize, usize>)>);

impl Definition for Passes {
    fn victim(&mut self, full: &FullSet) -> Option<usize> {
        let (hand, passed) = self.0.entry(full.set()).or_default();
        loop {
            let way = *hand;
            *hand = (*hand + 1) % full.held().len();
            let before = passed.insert(way, full.now()).unwrap_or(0);
            if !full.held()[way].uses()[1..].iter().any(|&use_of_it| use_of_it >= before) {
                return Some(way);
            }
        }
    }
}
