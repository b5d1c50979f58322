//! Which misses a cache shares with the fully associative LRU cache of its size, its twin.

use super::line_group::Running;
use crate::CacheConfig;
use crate::misses::Misses;

/// Compares the misses of caches with those of their twins, chunk by chunk.
pub(super) struct Twins {
    /// By model, indices of the line accesses of the chunk in hand that missed, and in how many of its caches.
    missed: Vec<Vec<(u32, u32)>>,
    pairs: Vec<Pair>,
}

/// A cache and its twin: model and number in it.
struct Pair {
    config: usize,
    cache: (usize, usize),
    twin: (usize, usize),
    /// Counted misses that both have.
    both: u64,
}

impl Twins {
    /// The caches of these models that have a twin among them; those that are their own have no need of one.
    pub(super) fn new(models: &[Running], configs: &[CacheConfig]) -> Self {
        let all = || {
            let of_model = |(at, running): (usize, &'_ Running)| {
                running.caches.iter().map(move |cache| (cache.config, (at, cache.counts))).collect::<Vec<_>>()
            };
            models.iter().enumerate().flat_map(of_model)
        };
        let pair = |(config, cache): (usize, (usize, usize))| {
            let twin = configs[config].full_lru_twin()?;
            let (_, twin) = all().find(|(other, _)| configs[*other] == twin)?;
            Some(Pair { config, cache, twin, both: 0 })
        };
        Self { missed: vec![vec![]; models.len()], pairs: all().filter_map(pair).collect() }
    }

    /// What a model missed in the chunk in hand.
    pub(super) fn note(&mut self, model: usize, misses: &Misses) {
        let missed = &mut self.missed[model];
        missed.clear();
        missed.extend(misses.list().iter().map(|miss| (miss.index, miss.caches)));
    }

    /// Counts what both of a pair missed.
    pub(super) fn compare(&mut self) {
        for pair in &mut self.pairs {
            let of = |(model, number): (usize, usize)| {
                self.missed[model].iter().filter(move |miss| number < miss.1 as usize).map(|miss| miss.0)
            };
            let mut twins = of(pair.twin).peekable();
            for index in of(pair.cache) {
                while twins.next_if(|&other| other < index).is_some() {}
                pair.both += u64::from(twins.peek() == Some(&index));
            }
        }
    }

    /// How many misses a cache shares with its twin; all of them, if it is its own.
    pub(super) fn both(&self, config: usize) -> Option<u64> {
        self.pairs.iter().find(|pair| pair.config == config).map(|pair| pair.both)
    }
}
