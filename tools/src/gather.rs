//! Gathering: radiance from the nearest photons, and the picture their sum makes.

mod estimate;
mod film;

pub use estimate::{Estimator, Outcome, RadianceEstimate};
pub use film::{Film, Overflow};

#[cfg(test)]
mod tests;
