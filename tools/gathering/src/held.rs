//! Means of irradiance in cells of one structure or another, looked up instead of k photons.

mod brick_map;
mod cell_cache;
mod cells;
mod footprint;
mod grid;
mod irradiance_cells;
mod patch;
mod structure;
mod structures;
mod voxel;

#[cfg(test)]
mod tests;

pub use cells::{CellMap, Place};
pub use footprint::{FOOTPRINT, Footprint};
pub use irradiance_cells::IrradianceCells;
pub use structure::{IrradianceStructure, Sample};
pub use structures::irradiance_structures;
