//! Irradiance caching: where to cache, how irradiance changes around there, and what a pixel takes of it.
//!
//! Ward, Rubinstein, Clear: *A Ray Tracing Solution for Diffuse Interreflection*, SIGGRAPH 1988; Ward, Heckbert:
//! *Irradiance Gradients*, Eurographics Workshop on Rendering 1992. The records are decided from geometry alone, before
//! any photon is looked up, so that every order of the queries sees the same ones.

mod gradients;
mod interpolate;
mod sites;

pub use gradients::{Coefficients, coefficients};
pub use interpolate::{CachedIrradiance, TERMS};
pub use sites::{Site, Sites};
