//! What results say: tables that are derived from the rows of sweeps, and judgements on them.
//!
//! Each is a file here and a line in [`derivations`]: from tables, and perhaps some settings, to a text. A judgement says as
//! well what does not hold. Whoever asks brings the tables, and says where others are.

mod accuracy;
mod batches;
mod budget;
mod cheapest;
mod claims;
mod compare;
mod coverage;
mod derivation;
mod exact;
mod flux;
mod frontier;
mod lattice;
mod least;
mod mean;
mod measured;
mod powers;
mod regions;
mod registry;
mod sampled;
mod structures;
mod table;
mod table1;
mod traffic;

pub use derivation::{Asked, Derivation, Derived};
pub use registry::derivations;
pub use table::Table;
