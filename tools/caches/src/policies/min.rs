//! Evicts the line whose next use is farthest: Belady's optimum (*A study of replacement algorithms for a virtual-storage
//! computer*, IBM Systems Journal 5, 1966), and the same where a fetched line may pass by, when consecutive accesses to it
//! count as one use.

use std::cmp::Reverse;

use super::Policy;
use crate::models::{Bypass, CacheModel, CacheOnTrace, FewWays, OneSet, Optimum};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// The line whose next use is farthest, Belady's optimum: none that keeps what it fetches fetches less
    pub(crate) struct Min = "min";
}

pm_registry::registered! {
    /// The same where a fetched line may also pass by the cache: nothing fetches less
    pub(crate) struct MinBypass = "min-bypass";
}

impl Policy for Min {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        optimum(cache, Bypass::Never)
    }
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(farthest)
    }
}

impl Policy for MinBypass {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        optimum(cache, Bypass::Allowed)
    }
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(|full: &FullSet| {
            let is_sooner = |&way: &usize| full.next_use(full.line()) < full.next_use(full.held()[way].line());
            farthest(full).filter(is_sooner)
        })
    }
    fn bypasses(&self) -> bool {
        true
    }
}

fn farthest(full: &FullSet) -> Option<usize> {
    full.least(|held| Reverse(full.next_use(held.line())))
}

fn optimum(cache: &CacheOnTrace, bypass: Bypass) -> Box<dyn CacheModel> {
    let (space, ways) = (cache.space(), cache.ways());
    if cache.sets() == 1 {
        Box::new(Optimum::new(cache.regions(), bypass, OneSet::new(space, ways, bypass)))
    } else {
        Box::new(Optimum::new(
            cache.regions(),
            bypass,
            FewWays::new(space.slots() as usize, cache.index(), ways, bypass),
        ))
    }
}
