//! Miss curves: what fully associative LRU caches of every size fetch, all from one reading; exact, or from a sample of the
//! lines.

mod collector;
mod curve;
mod histogram;
mod sampled_curve;
mod shards;
#[cfg(test)]
mod shards_tests;
mod stack_distance;
#[cfg(test)]
mod tests;

pub(crate) use collector::CurveCollector;
pub use curve::Curve;
use histogram::Histogram;
pub use sampled_curve::{Estimate, LEAST_MODEL, SampledCurve};
pub(crate) use shards::Shards;
use stack_distance::StackDistances;

use crate::TraceCounts;
