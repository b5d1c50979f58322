//! No cache at all.

use super::Policy;
use crate::models::{Answer, CacheModel, CacheOnTrace, Modelled, Uncached};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// No cache at all: every record goes to memory by itself, byte for byte
    pub(crate) struct NoCache = "none";
}

impl Policy for NoCache {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        Box::new(Uncached::new(cache.space()))
    }

    /// Whatever is asked, the distinct lines are the same.
    fn models(&self, caches: &[CacheOnTrace]) -> Vec<Modelled> {
        let answers = (0..caches.len()).map(|cache| Answer { cache, counts: 0 }).collect();
        caches.first().map(|first| Modelled { model: self.model(first), answers }).into_iter().collect()
    }

    /// Everything passes by.
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(|_: &FullSet| None)
    }

    fn keeps_lines(&self) -> bool {
        false
    }

    /// There is no state to forget.
    fn forgets_what_was_before(&self) -> bool {
        true
    }
}
