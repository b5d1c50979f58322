//! How the queries of a picture are made.

use super::reflection::Spread;
use super::strata::Strata;

/// How queries are made.
#[derive(Clone, Copy, Debug)]
pub struct GatherOptions {
    /// What is asked of the photon map.
    pub method: Method,
    /// Eye rays for each pixel: one goes through its middle, more are spread over it.
    pub samples: u32,
    /// Gather rays from each point seen.
    pub gathers: u32,
    /// How their directions are chosen.
    pub spread: Spread,
    /// Gather rays shorter than this, in scene units, are continued by one more bounce.
    pub min_gather_dist: f32,
    /// Shadow rays from each point seen, for direct light.
    pub light_samples: u32,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Is light wanted that needs no query? It changes no query.
    pub direct: bool,
    /// In which order the strata of a point are visited.
    pub strata: Strata,
    /// Does light count that comes to a point seen from a lamp through mirrors and glass? Not where a caustic map holds it.
    pub caustics: bool,
    /// What becomes of a gather ray at a mirror or glass.
    pub at_specular: AtSpecular,
    /// Do queries of gather rays that went by a mirror or through glass wait ([`PixelCaster::take_queued`](super::PixelCaster::take_queued))?
    pub queue_specular: bool,
}

pm_registry::choices! {
    /// What becomes of a gather ray at a mirror or glass.
    #[derive(Debug, Default)]
    pub enum AtSpecular {
        /// It goes on, reflected or refracted, to a surface that spreads light
        #[default]
        GoOn = "go-on",
        /// It is lost, and the picture lacks what it would have brought
        Stop = "stop",
        /// It asks there for what the surface spreads: nothing, if it is all mirror or glass
        Gather = "gather",
    }
}

/// What is asked of the photon map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// What gather rays from the points seen meet: all light but that straight from the lamps.
    FinalGather,
    /// The points seen themselves: all light that they reflect, as the map's photons hold that from the lamps as well.
    DirectVisualisation,
}
