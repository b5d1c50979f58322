//! What a sample tells of the whole: a ratio from one window of each stratum, and how far it may be off.

mod ratio;
mod spread;
mod student;
mod tuning;
pub mod windows;

pub use ratio::Ratio;
pub use spread::Spread;
pub use student::{student_quantile, student_within};
pub use tuning::{Missing, Round, Sample, Tuning};

/// The share of intervals that hold the truth, if all that they assume is true.
pub const CONFIDENCE: f64 = 0.95;
