//! Where a search starts: a hint that changes reads and never neighbours.

use super::chosen_ids::chosen_ids;
use super::{Blind, Nearest, PhotonMap, Search};
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

/// Photons that [`StartRadius::Auto`] looks at.
const FIT_SAMPLES: usize = 1000;
/// Share of them whose k-th neighbour the start radius reaches.
const FIT_QUANTILE: f64 = 0.99;

impl Search {
    /// The radius that 0.99 of the searches at 1,000 photons need, chosen by a hash of their ids: it depends on the map
    /// alone and not on the queries or their order.
    ///
    /// A search for one photon finds that at which it is, and needs no radius at all. Then it starts at the limit, unless that
    /// would be all that bounds it: a map that does not narrow its radius starts where two are found.
    #[must_use]
    pub fn fit_start(mut self, map: &(impl PhotonMap + ?Sized), photons: &[Photon]) -> Self {
        let fit = |k| fitted(map, photons, k);
        let radius = fit(self.k).or_else(|| if map.narrows() { None } else { fit(self.k + 1) });
        self.start = radius.unwrap_or(f32::INFINITY).min(self.max_dist);
        self
    }
}

/// The radius that is fit for k photons; none if that is 0, or k are nowhere.
fn fitted(map: &(impl PhotonMap + ?Sized), photons: &[Photon], k: usize) -> Option<f32> {
    let mut found = Nearest::new(k, f32::INFINITY);
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
    radii.get(at.min(radii.len().saturating_sub(1))).copied().filter(|&radius| radius > 0.0)
}
