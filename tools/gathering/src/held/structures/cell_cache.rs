//! The radiance caches of today's renderers.

use crate::held::cell_cache::CellCache as Table;
use crate::held::structure::photon_map;
use crate::held::{CellMap, FOOTPRINT, IrradianceStructure, Sample};
use pm_maps::{AnyMap, BuildError, Setting, Structure};

pm_registry::registered! {
    /// Irradiance in a hash table of cells by place, facing and footprint, as radiance caches have it: approximate
    pub struct CellCache = "cell-cache" with [FOOTPRINT];
}

impl Structure for CellCache {
    fn is_exact(&self) -> bool {
        false
    }

    fn forms(&self) -> &'static [&'static str] {
        &["", "--footprint 0.01", "--footprint 0.2"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        photon_map(setting)
    }
}

impl IrradianceStructure for CellCache {
    fn hold(&self, samples: &[Sample]) -> Box<dyn CellMap> {
        Box::new(Table::build(samples))
    }

    fn name(&self) -> &'static str {
        "hashed cells"
    }
}
