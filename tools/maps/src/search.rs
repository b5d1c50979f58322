//! One search with its radii: a limit, which is part of the answer, and a hint where to start, which is not.

use super::carry::Known;
use super::{AccessObserver, AnyMap, Nearest, PhotonMap, SearchReads};

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

impl Search {
    /// A search for `k` photons within `max_dist` that starts at the limit.
    #[must_use]
    pub const fn new(k: usize, max_dist: f32) -> Self {
        Self { k, max_dist, start: max_dist }
    }

    /// Finds the photons nearest to `point`. Returns the number of attempts it took.
    ///
    /// Each attempt is a whole search: a machine that guessed its radius too small has read all of it.
    #[inline]
    pub fn run(
        &self,
        map: &(impl PhotonMap + ?Sized),
        point: [f32; 3],
        found: &mut Nearest,
        eyes: &mut impl AccessObserver,
    ) -> u32 {
        self.run_within(Known::NOTHING, map, point, found, eyes)
    }

    /// Finds the photons nearest to each point of a batch. Returns the number of attempts it took, over all points.
    ///
    /// Who found too few searches again, together, with twice the radius.
    pub fn run_all(
        &self,
        map: &dyn AnyMap,
        points: &[[f32; 3]],
        found: &mut [Nearest],
        reads: &mut SearchReads,
    ) -> u32 {
        let mut radius = if map.is_exact() { self.start.min(self.max_dist) } else { self.max_dist };
        let mut asking: Vec<([f32; 3], &mut Nearest)> = points.iter().copied().zip(found).collect();
        let mut attempts = 0;
        while !asking.is_empty() {
            if attempts > 0 {
                reads.again();
            }
            attempts += asking.len() as u32;
            let points: Vec<[f32; 3]> = asking.iter().map(|&(point, _)| point).collect();
            let mut all: Vec<&mut Nearest> = asking.iter_mut().map(|(_, found)| &mut **found).collect();
            all.iter_mut().for_each(|found| found.restart(radius * radius));
            map.nearest_of_all_read(&points, &mut all, reads);
            asking.retain(|(_, found)| !(found.is_full() || radius >= self.max_dist || found.len() == map.len()));
            radius = beyond(radius).min(self.max_dist);
        }
        attempts
    }

    /// As [`run`](Self::run), where something is known of the answer.
    #[inline]
    pub(super) fn run_within(
        &self,
        known: Known,
        map: &(impl PhotonMap + ?Sized),
        point: [f32; 3],
        found: &mut Nearest,
        eyes: &mut impl AccessObserver,
    ) -> u32 {
        let sure = known.enough;
        // An approximate map reads no less for a smaller radius, and may never find k photons.
        let start = match map.is_exact() {
            // A hint a little below what is sure to do would seldom save much and sometimes fail, if a search narrows its radius.
            true if self.start * if map.narrows() { 2.0 } else { 1.0 } < sure => self.start,
            true => sure,
            false => self.max_dist,
        };
        let mut radius = start.min(self.max_dist);
        let mut attempts = 1;
        loop {
            found.restart_between(known.inside * known.inside.abs(), radius * radius);
            map.nearest(point, found, eyes);
            // With all photons in hand a larger radius finds no more.
            if found.is_full() || radius >= self.max_dist || found.len() == map.len() {
                return attempts;
            }
            attempts += 1;
            eyes.again();
            let larger = beyond(radius);
            radius = if radius < sure { larger.min(sure) } else { larger }.min(self.max_dist);
        }
    }
}

/// The radius that is tried after one that was too small. Past the square root of the largest number only infinity is left.
fn beyond(radius: f32) -> f32 {
    if radius > 1e18 { f32::INFINITY } else { radius * 2.0 }
}
