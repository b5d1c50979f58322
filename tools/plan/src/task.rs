//! What is to be planned, and why there may be no plan.

use crate::traffic::{SearchBytes, Trouble};
use pm_formats::Material;
use pm_light::scene::Camera;
use pm_light::transport::{PhotonPaths, Surfaces};
use pm_maps::BuildError;
use pm_random::Random;

/// What is to be planned.
pub struct Task<'a> {
    /// The scene, made ready for rays.
    pub surfaces: Surfaces<'a>,
    /// From where it is seen.
    pub camera: Camera,
    /// What its surfaces are made of, as in a stream's header.
    pub materials: &'a [Material],
    /// Light that mirrors and glass focus; none where they do not.
    pub caustics: Option<Caustics<'a>>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Seconds of processor time so far.
    pub clock: &'a dyn Fn() -> f64,
    /// Is told what is done next.
    pub doing: &'a dyn Fn(&str),
    /// Where bytes are what is to be saved: those of a search.
    pub search_bytes: Option<&'a SearchBytes<'a>>,
}

/// Photons of light that mirrors and glass focus.
pub struct Caustics<'a> {
    /// So many of them are worth the paths they take, at most.
    pub most: u64,
    /// Their paths, aimed.
    pub paths: PhotonPaths<'a>,
    /// Seconds of processor time that a picture takes to aim them.
    pub aiming: f64,
}

impl Task<'_> {
    /// Photons of caustics there may be at most.
    pub(crate) fn most_caustics(&self) -> u64 {
        self.caustics.as_ref().map_or(0, |caustics| caustics.most)
    }

    /// A seed for one of several uses.
    pub(crate) fn seed_of(&self, purpose: u64, number: u64) -> u64 {
        Random::new(&[self.seed, 0x706c_616e, purpose, number]).next_u64()
    }

    /// Number of pixels.
    pub(crate) fn pixels(&self) -> f64 {
        let [width, height] = self.camera.size();
        f64::from(width) * f64::from(height)
    }

    /// See [`is_large`].
    pub(crate) fn is_large(&self) -> bool {
        is_large(self.pixels())
    }
}

/// Does a picture of so many pixels take many seconds however it is made, as those of more than 256 x 256 do? Planning is to be cheap
/// beside it. A smaller one is planned as well as can be, which takes longer than the picture anyway.
#[must_use]
pub fn is_large(pixels: f64) -> bool {
    pixels > f64::from(1 << 16)
}

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// Nothing is seen.
    #[error("the camera sees no surface that is lit or could be: there is no picture to plan")]
    NothingSeen,
    /// There is no light.
    #[error("what the camera sees is black: no light comes there, or too little to be found by chance")]
    Dark,
    /// Bytes could not be measured.
    #[error("bytes of searches: {0}")]
    Traffic(Trouble),
    /// A map cannot be built.
    #[error(transparent)]
    Map(#[from] BuildError),
}
