//! What pixels add up to, free of order: a film whose sums are integers, and cached irradiance.

pub mod film;
pub mod hemisphere;
pub mod irradiance;
