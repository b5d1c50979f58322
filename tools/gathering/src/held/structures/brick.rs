//! The irradiance atlas.

use crate::held::brick_map::BrickMap;
use crate::held::structure::photon_map;
use crate::held::{CellMap, FOOTPRINT, IrradianceStructure, Sample};
use pm_maps::{AnyMap, BuildError, Setting, Structure};

pm_registry::registered! {
    /// Irradiance in an octree of bricks of 8 x 8 x 8 voxels (Christensen and Batali): approximate
    pub struct Brick = "brick" with [FOOTPRINT];
}

impl Structure for Brick {
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

impl IrradianceStructure for Brick {
    fn hold(&self, samples: &[Sample]) -> Box<dyn CellMap> {
        Box::new(BrickMap::build(samples))
    }

    fn name(&self) -> &'static str {
        "bricks of 8 x 8 x 8 voxels"
    }
}
