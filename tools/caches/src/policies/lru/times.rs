//! Evicts the least recently used line of a set of any number of ways.

use crate::models::Replacement;

/// Times of last use.
pub(super) struct LruTimes {
    last_use: Vec<u64>,
    now: u64,
    ways: usize,
}

impl LruTimes {
    pub(super) fn new(sets: usize, ways: usize) -> Self {
        Self { last_use: vec![0; sets * ways], now: 0, ways }
    }
}

impl Replacement for LruTimes {
    const REPEATS_MATTER: bool = false;

    #[inline]
    fn hit(&mut self, set: usize, way: usize) {
        self.last_use[set * self.ways + way] = self.now;
        self.now += 1;
    }

    #[inline]
    fn fill(&mut self, set: usize, way: usize) {
        self.hit(set, way);
    }

    #[inline]
    fn victim(&mut self, set: usize) -> usize {
        let times = &self.last_use[set * self.ways..][..self.ways];
        let (mut oldest, mut victim) = (times[0], 0);
        for (way, &time) in times.iter().enumerate() {
            // Selected, not branched on: which way is oldest is as good as random.
            victim = if time < oldest { way } else { victim };
            oldest = oldest.min(time);
        }
        victim
    }
}
