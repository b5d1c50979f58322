//! Gathering: queries answered from a photon map, and radiance from the photons found.

mod answer;
mod disc;
mod estimate;
mod kernel;
mod light_error;
mod lookups;
mod precomputed;

pub use answer::{Answered, Answerer, Fault, SearchCounts};
pub use estimate::{Edges, EstimateOptions, Estimator, Outcome, RadianceEstimate, Scratch};
pub use kernel::Kernel;
pub use light_error::LightError;
pub use lookups::Lookups;
pub use precomputed::{Precomputation, PrecomputationError, PrecomputedIrradiance};

#[cfg(test)]
mod tests;
