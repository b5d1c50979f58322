//! Russian roulette: how paths come to an end without a bias.

use pm_random::Random;

/// Survival is never surer than this, so that a path in a closed white room ends.
const MOST_CERTAIN: f32 = 0.999;
/// Specular hits in a row after which a path may end although nothing absorbs it: light can circle in glass for ever.
const PATIENCE: u32 = 32;

/// With probability `chance` (capped below 1) the weight that makes up for the other outcome.
pub(super) fn survive(chance: f32, random: &mut Random) -> Option<f32> {
    let chance = chance.min(MOST_CERTAIN);
    (random.unit() < chance).then(|| 1.0 / chance)
}

/// Patience with specular hits: after many in a row a path goes on with probability 0.95.
pub(super) fn patience(hits: u32, random: &mut Random) -> Option<f32> {
    if hits < PATIENCE { Some(1.0) } else { survive(0.95, random) }
}
