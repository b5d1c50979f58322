//! What was counted of windows, before it tells anything of the whole: what was counted elsewhere can be added.

use super::{WindowCounts, Windows};

/// What caches counted in some windows of a trace.
#[derive(Clone, Debug, PartialEq)]
pub struct CountedWindows {
    /// The batch of each window, in the order of the stream.
    pub batches: Vec<u64>,
    /// Queries of all windows, warm-up included.
    pub queries_simulated: u64,
    /// Of each cache, in the order they were given, what it counted in each window.
    pub caches: Vec<Vec<WindowCounts>>,
}

impl Windows {
    /// Ends the simulation: what was counted, to be added to that of other windows of the same trace.
    #[must_use]
    pub fn counted(mut self) -> CountedWindows {
        self.end_window();
        let caches = self.caches.into_iter().map(|cache| cache.windows).collect();
        CountedWindows { batches: self.over, queries_simulated: self.simulated, caches }
    }

    /// Adds what the same caches counted in other windows: since each window begins with empty caches, nothing else is needed
    /// of them. `false`, and nothing is added, if they are not that many caches and regions, or a batch is there already.
    #[must_use]
    pub fn add(&mut self, more: CountedWindows) -> bool {
        self.end_window();
        let CountedWindows { batches, queries_simulated, caches } = more;
        let is_of_these = |(cache, windows): (&super::CacheInWindows, &Vec<WindowCounts>)| {
            windows.len() == batches.len()
                && windows.iter().all(|window| {
                    let regions = [window.cache.region_fetches.len(), window.unknown.len()];
                    regions == [self.regions.len(); 2] && window.cache.config == cache.config
                })
        };
        if caches.len() != self.caches.len()
            || !self.caches.iter().zip(&caches).all(is_of_these)
            || !batches.is_sorted_by(|a, b| a < b)
            || batches.iter().any(|batch| self.over.contains(batch))
        {
            return false;
        }
        self.simulated += queries_simulated;
        let old = self.over.len();
        self.over.extend(batches);
        // Those of all parts in the order of the stream.
        let mut order: Vec<usize> = (0..self.over.len()).collect();
        order.sort_by_key(|&at| self.over[at]);
        for (cache, windows) in self.caches.iter_mut().zip(caches) {
            debug_assert_eq!(cache.windows.len(), old);
            cache.windows.extend(windows);
            cache.windows = order.iter().map(|&at| cache.windows[at].clone()).collect();
        }
        self.over.sort_unstable();
        true
    }
}
