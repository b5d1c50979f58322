//! What a policy builds a model from: a cache, and the lines of the trace.

use super::{CacheModel, MAX_FRAMES, Replacement, SetAssociative, Sets, set_associative::frames_of};
use crate::{CacheConfig, LineSpace, SimulationError};

/// A cache that is to be simulated on a trace.
#[derive(Clone, Copy)]
pub struct CacheOnTrace<'a> {
    config: CacheConfig,
    space: &'a LineSpace,
    regions: usize,
    ways: u64,
}

impl<'a> CacheOnTrace<'a> {
    /// `config` on a trace of so many regions, whose lines `space` numbers.
    ///
    /// # Errors
    /// If its sets and ways are more than the tables allow.
    pub(crate) fn new(config: CacheConfig, space: &'a LineSpace, regions: usize) -> Result<Self, SimulationError> {
        let ways = match config.sets() {
            // One set never holds more lines than there are: no more frames than needed, if the policy can have so many.
            1 => {
                let needed = config.lines().min(space.most_slots().max(1).next_power_of_two());
                let allowed = config.policy().entry().allows_ways(needed).is_ok();
                if allowed { needed } else { config.lines() }
            }
            sets => config.lines() / sets,
        };
        if frames_of(config.sets(), ways) > MAX_FRAMES {
            return Err(SimulationError::TooManyFrames(config));
        }
        Ok(Self { config, space, regions, ways })
    }

    /// The cache.
    #[must_use]
    pub fn config(&self) -> CacheConfig {
        self.config
    }

    /// The lines of the trace.
    #[must_use]
    pub fn space(&self) -> &'a LineSpace {
        self.space
    }

    /// Regions of the trace.
    #[must_use]
    pub fn regions(&self) -> usize {
        self.regions
    }

    /// How many sets it has.
    #[must_use]
    pub fn sets(&self) -> usize {
        self.config.sets() as usize
    }

    /// Ways of each set; of a fully associative cache no more than can be filled.
    #[must_use]
    pub fn ways(&self) -> usize {
        self.ways as usize
    }

    /// Which set a line belongs to.
    pub(crate) fn index(&self) -> Sets {
        Sets::new(self.config.sets(), self.config.index())
    }

    /// The model of sets and ways in which `replacement`, made for the same, says which line makes room.
    #[must_use]
    pub fn replacing<R: Replacement + 'static>(&self, replacement: R) -> Box<dyn CacheModel> {
        Box::new(SetAssociative::new(self.space, self.regions, self.index(), self.ways(), replacement))
    }
}
