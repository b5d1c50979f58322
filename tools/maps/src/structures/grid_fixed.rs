//! A grid whose cells are all of one size.

use super::SLOTS;
use crate::{AnyMap, BuildError, Cells, Grid, Setting, Structure};
use pm_registry::Parameter;

pm_registry::registered! {
    /// Uniform grid of cells of one size: what does not fit is lost
    pub struct GridFixed = "grid-fixed" with [Parameter { help: "photons in a cell [default: twice the average]", ..SLOTS }];
}

impl Structure for GridFixed {
    fn is_exact(&self) -> bool {
        false
    }

    fn forms(&self) -> &'static [&'static str] {
        // With room for all photons that there are in tests, where it is exact, and without.
        &["--slots 4000", "--slots 4000 --line 32", "--slots 4000 --line 320", "", "--slots 1"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        let cells = Cells::Fixed { line: setting.line(), slots: setting.values.count_if_any(SLOTS.name) };
        Ok(Box::new(Grid::build(setting.photons, cells)?))
    }
}
