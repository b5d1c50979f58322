//! The streams of the pm programs: photons, gather queries and access traces.
pub mod trace;
