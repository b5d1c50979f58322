//! What every policy has to say of itself.

use pm_registry::Registered;

use crate::models::{CacheModel, CacheOnTrace, Modelled};
use crate::trial::Definition;

/// Which line makes room for a new one: an entry of the registry.
///
/// The word and the help come from [`Registered`]. A policy of sets and ways is a [`Replacement`](crate::Replacement), and
/// its model is [`CacheOnTrace::replacing`] that. Everything else that is particular about a policy is a method here with
/// what is usual as its default.
pub trait Policy: Registered + Sync {
    /// The model of a cache under this policy; `cache.config().seed()` names its random numbers, if it draws any.
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel>;

    /// The model of a cache of which is asked when dirty lines leave. Where it cannot tell, that is refused.
    fn model_with_write_backs(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        self.model(cache)
    }

    /// The models of all caches of one line size that are under this policy: one each, or fewer that answer for several.
    fn models(&self, caches: &[CacheOnTrace]) -> Vec<Modelled> {
        caches.iter().enumerate().map(|(i, cache)| Modelled::one(i, self.model(cache))).collect()
    }

    /// What the policy does in the plainest way there is, in code of its own: [`trial`](crate::trial) holds the model
    /// against it. `sets` and `ways` are those of the cache; `seed` names the random numbers.
    fn definition(&self, sets: u64, ways: u64, seed: u64) -> Box<dyn Definition>;

    /// Whether it draws random numbers: then `WORD:SEED` names the sequence.
    fn draws_random_numbers(&self) -> bool {
        false
    }

    /// Whether there is a cache at all. Where there is none, each record goes to memory by itself, byte for byte, and a
    /// configuration is written `WORD` or `WORD,LINE`.
    fn keeps_lines(&self) -> bool {
        true
    }

    /// Whether a line that was fetched may pass by the cache without taking a place.
    fn bypasses(&self) -> bool {
        false
    }

    /// Whether a set that has seen as many distinct lines as it has ways holds the same lines as if it had run for ever:
    /// then it is known in a window of a trace from when on its counts are exact.
    fn forgets_what_was_before(&self) -> bool {
        false
    }

    /// Whether it can have so many ways; lines, where the cache is fully associative.
    ///
    /// # Errors
    /// What it needs, and what would do.
    fn allows_ways(&self, ways: u64) -> Result<(), WaysNeeded> {
        let _ = ways;
        Ok(())
    }
}

/// A policy cannot have so many ways.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WaysNeeded {
    /// What it needs, in words: "a power of two of ways".
    pub what: &'static str,
    /// The nearest number that would do.
    pub nearest: u64,
}
