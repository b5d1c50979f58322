//! Why windows cannot be simulated.

use thiserror::Error;

use crate::{CacheConfig, SimulationError};

/// Why windows cannot be simulated.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum WindowError {
    /// A policy that has no exact state that is known.
    #[error(
        "{0}: under this policy it is not known when a cache that began empty holds what it would hold in the whole stream; \
         choose lru or none, or simulate a trace that is not sampled in windows"
    )]
    Policy(CacheConfig),
    /// Nobody has laid out the memory of the trace.
    #[error("a trace of all addresses is not sampled in windows")]
    Addresses,
    /// No such simulation.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}
