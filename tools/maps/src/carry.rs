//! What a search knows from the one before.

use super::geometry::distance_squared;
use super::{AccessObserver, Nearest, PhotonMap, Search};

/// What the search before says of the next: the photons found for one point lie about another as well.
///
/// The k nearest photons of a point q' lie within r of it, so at least k lie within |q - q'| + r of q: the next search
/// can start there and never finds too few. A chain of searches is one stretch of the stream; it must be cut where the
/// stream says, never where threads do, or the reads would depend on them.
#[derive(Clone, Debug, Default)]
pub struct Carry {
    /// Point and k-th distance of the search before, if it found k photons.
    last: Option<([f32; 3], f32)>,
}

impl Carry {
    /// A radius within which k photons lie about `point`; infinite if none is known.
    fn sure(&self, point: [f32; 3]) -> f32 {
        let Some((last, radius)) = self.last else { return f32::INFINITY };
        let between = distance_squared(last, point).sqrt();
        // Each of the numbers is rounded by parts of 2^-22 at most, or is so small that its square is not exact.
        (between + radius) * 1.000_01 + 1e-18
    }

    /// Finds the photons nearest to `point` as [`Search::run`] does, starting from what the search before knew.
    #[inline]
    pub fn run(
        &mut self,
        search: &Search,
        map: &(impl PhotonMap + ?Sized),
        point: [f32; 3],
        found: &mut Nearest,
        eyes: &mut impl AccessObserver,
    ) -> u32 {
        let attempts = search.run_within(self.sure(point), map, point, found, eyes);
        self.last = found.farthest().filter(|_| found.is_full()).map(|(distance, _)| (point, distance.sqrt()));
        attempts
    }
}
