//! Random caches, of every policy.

use std::num::NonZeroU32;

use pm_registry::Registry;

use super::Draw;
use crate::{CacheConfig, ChosenPolicy, Policy, Ways};

/// The policies that keep lines; one that draws random numbers with two seeds.
pub(super) fn of_caches(policies: &Registry<dyn Policy>) -> Vec<ChosenPolicy> {
    let mut chosen = vec![];
    for entry in policies.iter().filter(|entry| entry.keeps_lines()) {
        let word = entry.word();
        let with = |text: &str| ChosenPolicy::parse(text, policies).unwrap_or_else(|error| panic!("{error}"));
        chosen.push(with(word));
        chosen.extend(entry.draws_random_numbers().then(|| with(&format!("{word}:7"))));
    }
    chosen
}

/// The nearest number of ways that the policy can have.
pub(super) fn ways_for(policy: ChosenPolicy, ways: u64) -> u64 {
    policy.entry().allows_ways(ways).map_or_else(|needed| needed.nearest, |()| ways)
}

/// A cache of any kind under this policy.
pub(super) fn random_cache(draw: &mut Draw, policy: ChosenPolicy) -> CacheConfig {
    let line = draw.pick(&[4, 16, 128, 128, 8192]);
    let full = draw.below(4) == 0;
    let ways = ways_for(
        policy,
        if full { draw.pick(&[1, 2, 3, 7, 20, 64, 1 << 30]) } else { draw.pick(&[1, 2, 3, 8, 16, 37]) },
    );
    // Powers of two of sets, and other numbers.
    let sets = draw.pick(&[1, 2, 4, 8, 16, 3, 7, 12]);
    let lines = if full { ways } else { ways * sets };
    let ways = if full { Ways::Full } else { some_ways(ways) };
    let config =
        CacheConfig::new(lines * u64::from(line), ways, line, policy).unwrap_or_else(|error| panic!("{error}"));
    if !full && sets.is_power_of_two() && draw.below(2) == 0 { config.hashed().expect("not full") } else { config }
}

/// So many ways.
pub(super) fn some_ways(ways: u64) -> Ways {
    Ways::N(NonZeroU32::new(ways as u32).expect("at least one way"))
}
