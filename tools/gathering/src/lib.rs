//! Gathering: radiance from the photons found near a point, and blocks of queries answered from a photon map.
//!
//! [`RadianceEstimate`] says what the k photons nearest to a query add to its pixel; [`Answerer`] answers a block of
//! queries, with the trace of what that read; [`PrecomputedIrradiance`] answers those of diffuse surfaces from a few
//! estimates made beforehand, and [`IrradianceCells`] holds such estimates in the structures of [`irradiance_structures`];
//! [`PhotonRadii`] lets each photon say for whom it counts. The sum over the k nearest photons is exact or in the order of their
//! ids, so that a picture does not depend on which map found them, nor in which order.

mod answer;
mod answered;
mod disc;
mod estimate;
mod held;
mod held_irradiance;
mod kernel;
mod light_error;
mod lobe;
mod lookups;
mod options;
mod photon_radii;
mod precomputed;
mod surface;

pub use answer::Answerer;
pub use answered::{Answered, Fault, SearchCounts};
pub use estimate::{RadianceEstimate, Scratch};
pub use held::{
    CellMap, FOOTPRINT, Footprint, IrradianceCells, IrradianceStructure, Place, Sample, irradiance_structures,
};
pub use held_irradiance::HeldIrradiance;
pub use kernel::Kernel;
pub use light_error::LightError;
pub use lookups::Lookups;
pub use options::{Edges, EstimateOptions, Estimator, Outcome};
pub use photon_radii::PhotonRadii;
pub use precomputed::{Precomputation, PrecomputationError, PrecomputedIrradiance};
