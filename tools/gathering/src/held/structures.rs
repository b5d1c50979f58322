//! The structures that hold irradiance: a file each, and a line here.

mod brick;
mod cell_cache;

use super::IrradianceStructure;
use pm_registry::Registry;

/// The structures of held irradiance that there are.
#[must_use]
pub fn irradiance_structures() -> Registry<dyn IrradianceStructure> {
    Registry::new("map", &[&brick::Brick, &cell_cache::CellCache])
}
