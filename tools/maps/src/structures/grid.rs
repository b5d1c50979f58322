//! A grid whose cells are as large as they need to be.

use crate::{AnyMap, BuildError, Cells, Setting, Structure};

pm_registry::registered! {
    /// Uniform grid with a directory of its cells
    pub struct Grid = "grid";
}

impl Structure for Grid {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        Ok(Box::new(crate::Grid::build(setting.photons, Cells::Indirect)?))
    }
}
