//! Gathering: queries answered from a photon map, and radiance from the photons found.

mod answer;
mod estimate;

pub use answer::{Answered, Answerer, Fault, SearchCounts};
pub use estimate::{Estimator, Outcome, RadianceEstimate};

#[cfg(test)]
mod tests;
