//! Photon maps: who are the k nearest photons, and which memory does it take to find out?
//!
//! Every search is written once. It tells an [`AccessObserver`] which records it reads; an observer that does nothing
//! costs nothing, so the picture that is checked and the accesses that are counted come from the same code.

mod accuracy;
mod any;
mod block_hash;
mod brute_force;
mod bucket_kd;
mod building;
pub mod gather;
mod grid;
mod kd_tree;
mod kdb_tree;
mod layout;
mod leaves;
mod nearest;
mod observer;
mod search;
mod split_tree;
mod vvh;

pub use accuracy::Accuracy;
pub use any::{AnyMap, MapKind, MapOptions};
pub use block_hash::{BlockHash, BlockHashOptions, Orphans};
pub use brute_force::BruteForce;
pub use bucket_kd::BucketKdTree;
pub use building::Building;
pub use grid::{Cells, Grid};
pub use kd_tree::KdTree;
pub use kdb_tree::{KdbOptions, KdbTree, PageForm};
pub use layout::Layout;
pub use nearest::Nearest;
pub use observer::{AccessObserver, Blind, Visits};
pub use search::{Carry, Search, StartRadius};
pub use vvh::VvhTree;

use pm_formats::Photon;
use pm_formats::trace::Region;
use pm_random::mix;

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

    /// Bytes of the lines that no record of the map crosses, if its records are padded; else they are packed.
    fn padding(&self) -> Option<u32> {
        None
    }

    /// True if the photons found are always the nearest.
    fn is_exact(&self) -> bool {
        true
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
    /// More lines than can be told apart.
    #[error("the map would have more than 4,294,967,295 lines; ask for fewer --slots or --thresholds")]
    TooLarge,
}

/// Byte offset of a record in its region, whether records are packed or padded (see [`PhotonMap::padding`]).
#[inline]
#[must_use]
pub fn offset_of(record: u32, record_size: u32, padding: Option<u32>) -> u64 {
    match padding {
        Some(line) => {
            let in_line = line / record_size;
            u64::from(record / in_line) * u64::from(line) + u64::from(record % in_line * record_size)
        }
        None => u64::from(record) * u64::from(record_size),
    }
}

/// Squared distance as every map computes it.
#[inline(always)]
pub(crate) fn distance_squared(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [dx, dy, dz] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (dx * dx + dy * dy) + dz * dz
}

/// Least and greatest coordinates along each axis.
type Box3 = ([f32; 3], [f32; 3]);

/// The smallest box that holds all of some positions.
fn extent(positions: impl IntoIterator<Item = [f32; 3]>) -> Box3 {
    let none = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    positions.into_iter().fold(none, |(low, high), position| {
        ([0, 1, 2].map(|axis| position[axis].min(low[axis])), [0, 1, 2].map(|axis| position[axis].max(high[axis])))
    })
}

/// The axis along which a box is longest, the first of equals.
fn longest_axis(bounds: &Box3) -> usize {
    let side = |axis: usize| bounds.1[axis] - bounds.0[axis];
    (1..3).fold(0, |longest, axis| if side(axis) > side(longest) { axis } else { longest })
}

/// Ids of at most `most` photons, chosen by a hash of them: a sample that depends on the photons alone and not on the
/// queries or their order. In no order.
fn chosen_ids(photons: &[Photon], most: usize) -> Vec<u32> {
    let mut ids: Vec<u32> = (0..u32::try_from(photons.len()).expect("maps hold fewer than 2^30 photons")).collect();
    if ids.len() > most {
        ids.select_nth_unstable_by_key(most, |&id| (mix(u64::from(id)), id));
        ids.truncate(most);
    }
    ids
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
mod stability;
#[cfg(test)]
mod tests;
