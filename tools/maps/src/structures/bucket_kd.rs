//! A kd-tree with photons in its leaves.

use super::LAYOUT;
use crate::{AnyMap, BucketKdTree, BuildError, Setting, Structure};

pm_registry::registered! {
    /// kd-tree of split planes, apart from photon leaves of one line
    pub struct BucketKd = "bucket-kd" with [LAYOUT];
}

impl Structure for BucketKd {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--line 32", "--line 320", "--layout veb --line 64"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        let layout = setting.values.choice(LAYOUT.name);
        Ok(Box::new(BucketKdTree::build(setting.photons, layout, setting.line())?))
    }
}
