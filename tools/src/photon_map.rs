//! Photon maps: who are the k nearest photons, and which memory does it take to find out?
//!
//! Every search is written once. It tells an [`AccessObserver`] which records it reads; an observer that does nothing
//! costs nothing, so the picture that is checked and the accesses that are counted come from the same code.

mod brute_force;
mod kd_tree;
mod nearest;
mod observer;
mod search;

pub use brute_force::BruteForce;
pub use kd_tree::{KdTree, Layout};
pub use nearest::Nearest;
pub use observer::{AccessObserver, Blind, Visits};
pub use search::{Search, StartRadius};

use pm_formats::Photon;
use pm_formats::trace::Region;

/// A structure that finds the photons nearest to a point.
///
/// The contract all exact maps share: squared distances are `(dx * dx + dy * dy) + dz * dz` in `f32` without fused
/// operations; photons within the bound (inclusive) are found; of more than k, the k smallest by (distance, photon id).
/// So the answer depends on nothing but the photons and the query.
pub trait PhotonMap: Sync {
    /// The memory the map would live in, each region as it is to be traced, with or without second touches.
    fn regions(&self, reread: bool) -> Vec<Region>;

    /// Number of photons.
    fn len(&self) -> usize;

    /// True if there are no photons.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Adds to `found` the photons nearest to `point`, within its bound.
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver);
}

/// Why photons cannot be put into a map.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum BuildError {
    /// A coordinate that is not finite, or so large that squared distances overflow.
    #[error("photon {0} lies at a coordinate that is not finite or beyond 1e18; was the scene scaled wrongly?")]
    Coordinate(usize),
    /// Photon ids must fit 30 bits.
    #[error("{0} photons are more than a map can hold (1,073,741,823)")]
    TooMany(usize),
}

/// Squared distance as every map computes it.
#[inline(always)]
pub(crate) fn distance_squared(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [dx, dy, dz] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (dx * dx + dy * dy) + dz * dz
}

/// Photons that a map can be built from.
fn check(photons: &[Photon]) -> Result<(), BuildError> {
    if photons.len() >= 1 << 30 {
        return Err(BuildError::TooMany(photons.len()));
    }
    // Also false for NaN.
    let usable = |photon: &Photon| photon.position.iter().all(|x| x.abs() <= 1e18);
    photons.iter().position(|photon| !usable(photon)).map_or(Ok(()), |index| Err(BuildError::Coordinate(index)))
}

#[cfg(test)]
mod tests;
