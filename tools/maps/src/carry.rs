//! What a search knows from the one before.

use super::geometry::distance_squared;
use super::{AccessObserver, Nearest, PhotonMap, Search};

/// What is known of a search's answer beforehand, as radii in scene units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    /// All photons within this are among the k nearest; negative if nothing is known.
    pub(super) inside: f32,
    /// At least k photons lie within this.
    pub(super) enough: f32,
}

impl Known {
    pub(super) const NOTHING: Self = Self { inside: -1.0, enough: f32::INFINITY };

    /// What a point whose k-th photon is at `radius` says of another, so far from it.
    #[inline(always)]
    pub(super) fn beside(between: f32, radius: f32) -> Self {
        // Each of the numbers is rounded by parts of 2^-22 at most, or is so small that its square is not exact.
        let enough = (between + radius) * 1.000_01 + 1e-18;
        let inside = if radius > between { (radius - between) - (radius + between) * 1e-5 - 1e-18 } else { -1.0 };
        Self { inside, enough }
    }
}

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
    /// Point and k-th distance of the search before, if it found k photons.
    pub(super) const fn last(&self) -> Option<([f32; 3], f32)> {
        self.last
    }

    /// These photons were found for this point, by whatever search.
    pub(super) fn follow(&mut self, point: [f32; 3], found: &Nearest) {
        self.last = found.is_full().then(|| (point, found.bound().sqrt()));
    }

    /// What is known about `point`: fewer than k photons lie nearer than r - |q - q'|, and k within r + |q - q'|.
    fn known(&self, point: [f32; 3]) -> Known {
        let Some((last, radius)) = self.last else { return Known::NOTHING };
        Known::beside(distance_squared(last, point).sqrt(), radius)
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
        let attempts = search.run_within(self.known(point), map, point, found, eyes);
        self.follow(point, found);
        attempts
    }
}
