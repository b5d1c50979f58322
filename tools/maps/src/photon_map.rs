//! What a photon map is.

use super::{AccessObserver, Ball, Nearest, Vicinity};
use pm_formats::Number;
use pm_formats::trace::Region;
use std::sync::Arc;

/// A structure that finds the photons nearest to a point.
///
/// The contract all exact maps share: squared distances are `(dx * dx + dy * dy) + dz * dz` in `f32` without fused
/// operations; photons within the bound (inclusive) are found; of more than k, the k smallest by (distance, photon id).
/// So the answer depends on nothing but the photons and the query.
pub trait PhotonMap: Send + Sync {
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

    /// Ids of the photons in the order in which they lie in the map, if searches tell of them by their places in it
    /// ([`Nearest::places`]): what is asked of the photons found is better kept in that order.
    fn order(&self) -> Option<&Arc<[u32]>> {
        None
    }

    /// Does a search narrow its radius as it finds photons? Of one that does not, the first radius is all that matters.
    fn narrows(&self) -> bool {
        true
    }

    /// Do searches tell what each read waits for ([`AccessObserver::read_after`])? Of one that does not, nobody can say which
    /// of its misses wait for which.
    fn tells_waits(&self) -> bool {
        false
    }

    /// What building it has brought to light, by name: the same for the same photons and values.
    fn measures(&self) -> Vec<(&'static str, Number)> {
        vec![]
    }

    /// Of a map that may miss photons of a block: number of the region of its blocks, and the block of each photon.
    fn blocks(&self) -> Option<(u16, Vec<u32>)> {
        None
    }

    /// Queries that are answered together, if it does not answer one by one: of a batch [`nearest_of_all`](Self::nearest_of_all)
    /// reads less than of each of its queries by itself.
    fn batch(&self) -> Option<usize> {
        None
    }

    /// [`nearest`](Self::nearest) of each point of a batch.
    fn nearest_of_all(&self, points: &[[f32; 3]], found: &mut [&mut Nearest], eyes: &mut impl AccessObserver) {
        for (&point, found) in points.iter().zip(found) {
            self.nearest(point, found, eyes);
        }
    }

    /// Queries of a group at most: neighbours that follow each other share a search, if it is more than 1. See [`Groups`](super::Groups).
    fn group(&self) -> usize {
        1
    }

    /// Collects the photons among which the nearest of all queries in a ball are. `false` if that cannot be done, or k photons
    /// are not there: then the queries are to be answered one by one. `room` is emptied.
    fn surround(&self, ball: &Ball, into: &mut Vicinity, room: &mut Nearest, eyes: &mut impl AccessObserver) -> bool {
        let _ = (ball, into, room, eyes);
        false
    }

    /// Finds the photons nearest to `point`, at most so far, of a group about which photons were [collected](Self::surround).
    fn nearest_of_surrounding(&self, vicinity: &Vicinity, point: [f32; 3], max_dist: f32, found: &mut Nearest) {
        let _ = (vicinity, point, max_dist, found);
        unreachable!("nothing was collected");
    }

    /// Finds the photons nearest to `point`, within the bound of `found`, which holds none before.
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver);
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
