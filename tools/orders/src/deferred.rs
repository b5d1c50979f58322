//! The deferred orders: a file each, and a line here.

mod buffered;
mod cells;
mod hashed;
mod hilbert;
mod leaf;
mod morton;
mod partition;
mod random;
mod snowplow;

use super::Order;
use pm_registry::{Domain, Parameter, Registry};

/// The deferred orders that there are.
#[must_use]
pub fn orders() -> Registry<dyn Order> {
    Registry::new(
        "order",
        &[
            &hilbert::Hilbert,
            &morton::Morton,
            &leaf::Leaf,
            &random::Random,
            &hashed::Hashed,
            &partition::Partition,
            &cells::Cells,
            &snowplow::Snowplow,
            &buffered::Buffered,
        ],
    )
}

/// The photons whose cells an order goes by.
const PHOTONS: Parameter = Parameter::new("photons", Domain::File, "photon map whose leaves are its cells");
/// How fine those cells are.
const LEAF_PHOTONS: Parameter =
    Parameter::new("leaf-photons", Domain::count(1, u32::MAX as u64), "most photons of such a cell");
/// Side of the cells of a regular grid.
const CELL: Parameter = Parameter::new("cell", Domain::Length, "side of its cells, in scene units");
