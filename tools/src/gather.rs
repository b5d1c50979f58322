//! Gathering: radiance from the nearest photons.

mod estimate;

pub use estimate::{Estimator, Outcome, RadianceEstimate};

#[cfg(test)]
mod tests;
