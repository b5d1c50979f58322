//! How photons become a radiance, and what became of a query.

use super::Kernel;

pm_registry::choices! {
    /// How the photons found become a radiance.
    #[derive(Debug)]
    pub enum Estimator {
        /// The k-th photon sets the radius and is not summed: unbiased where photons are spread evenly
        Unbiased = "unbiased",
        /// All k photons are summed, as in the textbook: k/(k-1) too bright for ever
        Classic = "classic",
    }
}

pm_registry::choices! {
    /// Which area the flux is divided by.
    #[derive(Debug)]
    pub enum Edges {
        /// The part of the photons' disc on this side of the edges that photons round the corner show
        Cut = "cut",
        /// As cut, and photons of a cut disc are weighed so that light that falls off towards an edge is not found too bright
        Sloped = "sloped",
        /// The whole disc, as in the textbook, though photons beyond an edge are left out: dark at edges
        Ignored = "ignored",
    }
}

/// What searches were made, and how photons become a radiance.
#[derive(Clone, Copy, Debug)]
pub struct EstimateOptions {
    /// Photons searched for.
    pub k: usize,
    /// Largest distance at which a photon counts, in scene units.
    pub max_dist: f32,
    /// Which photons are summed.
    pub estimator: Estimator,
    /// How much each counts by its distance.
    pub kernel: Kernel,
    /// Which area the sum is divided by.
    pub edges: Edges,
}

/// What became of a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// Radiance towards the viewer, linear RGB, times the query's weight.
    Radiance([f64; 3]),
    /// The nearest photons all lie at the query's own point, so that their disc has no area: nothing can be said.
    NoArea,
}
