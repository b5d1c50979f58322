//! The cache that all elements share, behind their own.

use pm_formats::trace::{Region, TraceSink as _};

use crate::lines::CHUNK;
use crate::misses::{access_of, hold_lines};
use crate::simulation::Moved;
use crate::{CacheConfig, CacheCounts, Simulation, SimulationError};

/// A cache that is asked for what private ones do not hold, in the order of the elements' turns.
pub(super) struct Shared {
    cache: Simulation,
    /// The traced memory, in lines of the private caches.
    regions: Vec<Region>,
    line_bytes: u64,
    /// Turns so far.
    now: u64,
    /// Of each element, its accesses that were passed on, and the turns of those that were not, each with whether it counts.
    turns: Vec<(u64, Vec<(u64, bool)>)>,
    warm_up: bool,
}

impl Shared {
    /// Behind private caches of these lines.
    pub(super) fn new(
        regions: &[Region],
        line_bytes: u32,
        config: CacheConfig,
        elements: usize,
    ) -> Result<Self, SimulationError> {
        let mut regions = regions.to_vec();
        regions.iter_mut().for_each(|region| hold_lines(region, line_bytes));
        Ok(Self {
            cache: Simulation::new(&regions, &[config])?,
            regions,
            line_bytes: line_bytes.into(),
            now: 0,
            turns: vec![(0, vec![]); elements],
            warm_up: false,
        })
    }

    /// An element makes an access. True if it is time to pass on what was fetched.
    pub(super) fn turn(&mut self, element: usize, counted: bool) -> bool {
        let turns = &mut self.turns[element].1;
        turns.push((self.now, counted));
        self.now += 1;
        turns.len() >= CHUNK
    }

    /// Asks for what the private caches have fetched since the last time.
    pub(super) fn pass_on<'a>(&mut self, elements: impl Iterator<Item = &'a mut Simulation>) {
        let mut fetched: Vec<((u64, bool), Moved)> = vec![];
        for (caches, (passed, turns)) in elements.zip(&mut self.turns) {
            let of_element = caches.take_fetched_by().into_iter();
            // Accesses are numbered from 1 on.
            fetched.extend(of_element.map(|(by, moved)| (turns[(by - 1 - *passed) as usize], moved)));
            *passed += turns.len() as u64;
            turns.clear();
        }
        // Lines of one access stay in their order.
        fetched.sort_by_key(|((turn, _), _)| *turn);
        for ((_, counted), moved) in fetched {
            if self.warm_up == counted {
                self.warm_up = !counted;
                self.cache.block(0, self.warm_up);
            }
            self.cache.access(access_of(&self.regions, self.line_bytes, moved));
        }
    }

    /// What it fetched, when all is over.
    pub(super) fn finish<'a>(mut self, elements: impl Iterator<Item = &'a mut Simulation>) -> CacheCounts {
        self.pass_on(elements);
        self.cache.finish().remove(0)
    }
}
