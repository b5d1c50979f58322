//! Parameters that several orders take.

use pm_registry::{Domain, Parameter};

/// The photons whose cells an order goes by.
pub(super) const PHOTONS: Parameter = Parameter::new("photons", Domain::File, "photon map whose leaves are cells");
/// How fine those cells are.
pub(super) const LEAF_PHOTONS: Parameter =
    Parameter::new("leaf-photons", Domain::count(1, u32::MAX as u64), "most photons of such a cell");
/// Side of the cells of a regular grid.
pub(super) const CELL: Parameter = Parameter::new("cell", Domain::Length, "side of its cells, in scene units");
