//! A kd-tree split by the expected work.

use crate::{AnyMap, BuildError, Setting, Structure, VvhTree};

pm_registry::registered! {
    /// kd-tree split by the voxel volume heuristic
    pub struct Vvh = "vvh";
}

impl Structure for Vvh {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--line 32", "--line 320"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        Ok(Box::new(VvhTree::build(setting.photons, setting.k, setting.line())?))
    }
}
