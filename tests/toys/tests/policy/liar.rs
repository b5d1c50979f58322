//! The same, but for that it says that it need not see a use of the line used last: a mistake that the trials must find.

use super::lfu::{Lfu, Uses};
use pm_caches::trial::Definition;
use pm_caches::{CacheModel, CacheOnTrace, Policy, Replacement};

pm_registry::registered! {
    /// A mistake
    pub(crate) struct Liar = "lfu-liar";
}

impl Policy for Liar {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Blind(Uses::new(cache.sets(), cache.ways())))
    }

    fn definition(&self, sets: u64, ways: u64, seed: u64) -> Box<dyn Definition> {
        Lfu.definition(sets, ways, seed)
    }
}

struct Blind(Uses);

impl Replacement for Blind {
    const REPEATS_MATTER: bool = false;

    fn hit(&mut self, set: usize, way: usize) {
        self.0.hit(set, way);
    }

    fn fill(&mut self, set: usize, way: usize) {
        self.0.fill(set, way);
    }

    fn victim(&mut self, set: usize) -> usize {
        self.0.victim(set)
    }
}
