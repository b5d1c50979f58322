//! Jensen's photon map.

use super::LAYOUT;
use crate::{AnyMap, BuildError, KdTree, Setting, Structure};
use pm_registry::{Domain, Parameter};

const PAD: Parameter = Parameter::new("pad", Domain::Flag, "pad the records, so that none crosses a line").hidden();

pm_registry::registered! {
    /// Left-balanced kd-tree, 20-byte nodes, Jensen's search
    pub struct Kd = "kd" with [LAYOUT, PAD];
}

impl Structure for Kd {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--layout preorder", "--layout veb", "--pad", "--layout veb --pad --line 64"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        let tree = KdTree::build(setting.photons, setting.values.choice(LAYOUT.name))?;
        Ok(Box::new(if setting.values.flag(PAD.name) { tree.padded(setting.line())? } else { tree }))
    }
}
