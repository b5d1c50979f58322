//! One search with its radii: a limit, which is part of the answer, and a hint where to start, which is not.

use super::{AccessObserver, Blind, Nearest, PhotonMap, chosen_ids};
use pm_formats::Photon;

/// Where a search starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StartRadius {
    /// At the limit: the bound only shrinks once k photons are held.
    Unbounded,
    /// At a radius fit for the map: see [`Search::fit_start`].
    Auto,
    /// At this radius, in scene units.
    Fixed(f32),
}

/// How photons are searched for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Number of photons.
    pub k: usize,
    /// Largest distance, in scene units; may be infinite.
    pub max_dist: f32,
    /// First radius tried; doubled until k photons are found or `max_dist` is reached. Changes reads, never neighbours.
    pub start: f32,
}

/// Photons that [`StartRadius::Auto`] looks at.
const FIT_SAMPLES: usize = 1000;
/// Share of them whose k-th neighbour the start radius reaches.
const FIT_QUANTILE: f64 = 0.99;

impl Search {
    /// A search for `k` photons within `max_dist` that starts at the limit.
    #[must_use]
    pub const fn new(k: usize, max_dist: f32) -> Self {
        Self { k, max_dist, start: max_dist }
    }

    /// The radius that 0.99 of the searches at 1,000 photons need, chosen by a hash of their ids: it depends on the map
    /// alone and not on the queries or their order.
    #[must_use]
    pub fn fit_start(mut self, map: &impl PhotonMap, photons: &[Photon]) -> Self {
        let mut found = Nearest::new(self.k, f32::INFINITY);
        let mut radii: Vec<f32> = chosen_ids(photons, FIT_SAMPLES)
            .into_iter()
            .filter_map(|id| {
                found.restart(f32::INFINITY);
                map.nearest(photons[id as usize].position, &mut found, &mut Blind);
                found.is_full().then(|| found.bound().sqrt())
            })
            .collect();
        radii.sort_by(f32::total_cmp);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "0 ..= 1000"
        )]
        let at = (FIT_QUANTILE * radii.len() as f64) as usize;
        let radius = radii.get(at.min(radii.len().saturating_sub(1))).copied().filter(|&radius| radius > 0.0);
        self.start = radius.unwrap_or(f32::INFINITY).min(self.max_dist);
        self
    }

    /// Finds the photons nearest to `point`. Returns the number of attempts it took.
    ///
    /// Each attempt is a whole search: a machine that guessed its radius too small has read all of it.
    #[inline]
    pub fn run(
        &self,
        map: &impl PhotonMap,
        point: [f32; 3],
        found: &mut Nearest,
        eyes: &mut impl AccessObserver,
    ) -> u32 {
        self.run_within(f32::INFINITY, map, point, found, eyes)
    }

    /// As [`run`](Self::run), where k photons are known to lie within `sure`, in scene units.
    #[inline]
    fn run_within(
        &self,
        sure: f32,
        map: &impl PhotonMap,
        point: [f32; 3],
        found: &mut Nearest,
        eyes: &mut impl AccessObserver,
    ) -> u32 {
        // An approximate map reads no less for a smaller radius, and may never find k photons.
        let start = match map.is_exact() {
            // A hint a little below what is sure to do would seldom save much and sometimes fail.
            true if self.start * 2.0 < sure => self.start,
            true => sure,
            false => self.max_dist,
        };
        let mut radius = start.min(self.max_dist);
        let mut attempts = 1;
        loop {
            found.restart(radius * radius);
            map.nearest(point, found, eyes);
            // With all photons in hand a larger radius finds no more.
            if found.is_full() || radius >= self.max_dist || found.len() == map.len() {
                return attempts;
            }
            attempts += 1;
            // Past the square root of the largest number only infinity is left to try.
            let larger = if radius > 1e18 { f32::INFINITY } else { radius * 2.0 };
            radius = if radius < sure { larger.min(sure) } else { larger }.min(self.max_dist);
        }
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
    /// A radius within which k photons lie about `point`; infinite if none is known.
    fn sure(&self, point: [f32; 3]) -> f32 {
        let Some((last, radius)) = self.last else { return f32::INFINITY };
        let between = super::distance_squared(last, point).sqrt();
        // Each of the numbers is rounded by parts of 2^-22 at most, or is so small that its square is not exact.
        (between + radius) * 1.000_01 + 1e-18
    }

    /// Finds the photons nearest to `point` as [`Search::run`] does, starting from what the search before knew.
    #[inline]
    pub fn run(
        &mut self,
        search: &Search,
        map: &impl PhotonMap,
        point: [f32; 3],
        found: &mut Nearest,
        eyes: &mut impl AccessObserver,
    ) -> u32 {
        let attempts = search.run_within(self.sure(point), map, point, found, eyes);
        self.last = found.farthest().filter(|_| found.is_full()).map(|(distance, _)| (point, distance.sqrt()));
        attempts
    }
}
