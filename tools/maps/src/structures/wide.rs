//! The map for speed.

use crate::{AnyMap, BuildError, Setting, Structure, WideTree};

pm_registry::registered! {
    /// Tree of sixteen boxes a node and sixteen photons a leaf, searched side by side: the fast one
    pub struct Wide = "wide";
}

impl Structure for Wide {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        Ok(Box::new(WideTree::build(setting.photons)?))
    }
}
