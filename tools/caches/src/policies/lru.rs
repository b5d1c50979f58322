//! Evicts the least recently used line.

mod order;
mod times;

use std::collections::BTreeMap;

use super::Policy;
use crate::models::{Answer, CacheModel, CacheOnTrace, MAX_SIZES, Modelled, lru_stack};
use crate::trial::{Definition, FullSet};
use order::LruOrder;
use times::LruTimes;

pm_registry::registered! {
    /// The least recently used line
    pub(crate) struct Lru = "lru";
}

impl Policy for Lru {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        match cache.sets() {
            // A single set is fully associative, whatever it is called.
            1 => lru_stack(cache.space(), cache.regions(), &[cache.config().lines()]),
            _ => self.model_with_write_backs(cache),
        }
    }

    /// The stack knows how many lines left dirty, but not when.
    fn model_with_write_backs(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        let (sets, ways) = (cache.sets(), cache.ways());
        match ways {
            _ if ways <= LruOrder::WAYS => cache.replacing(LruOrder::new(sets, ways)),
            _ => cache.replacing(LruTimes::new(sets, ways)),
        }
    }

    /// One stack for all sizes of a single set.
    fn models(&self, caches: &[CacheOnTrace]) -> Vec<Modelled> {
        let (full, in_sets): (Vec<usize>, Vec<usize>) = (0..caches.len()).partition(|&i| caches[i].sets() == 1);
        let mut models: Vec<Modelled> = in_sets.into_iter().map(|i| Modelled::one(i, self.model(&caches[i]))).collect();
        // By lines held, ascending; several caches may be of one size.
        let mut by_lines: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        full.into_iter().for_each(|i| by_lines.entry(caches[i].config().lines()).or_default().push(i));
        let sizes: Vec<(u64, Vec<usize>)> = by_lines.into_iter().collect();
        for sizes in sizes.chunks(MAX_SIZES) {
            let (lines, alike): (Vec<u64>, Vec<&Vec<usize>>) = sizes.iter().map(|(lines, of)| (*lines, of)).unzip();
            let answers = alike.into_iter().enumerate();
            let answers = answers.flat_map(|(counts, of)| of.iter().map(move |&cache| Answer { cache, counts }));
            let first = &caches[sizes[0].1[0]];
            let model = lru_stack(first.space(), first.regions(), &lines);
            models.push(Modelled { model, answers: answers.collect() });
        }
        models
    }

    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(|full: &FullSet| full.least(|held| held.last_use()))
    }

    /// A set holds the lines of it last used, as many as it has ways.
    fn forgets_what_was_before(&self) -> bool {
        true
    }
}
