//! The map for speed.

use crate::{AnyMap, BuildError, Setting, Structure, WideTree};
use pm_registry::{Domain, Parameter};

const GROUP: Parameter = Parameter::new("group", Domain::count(1, 64), "neighbouring queries that share a search at most")
    .called("QUERIES")
    .with_details(
        "Photons about all of them are read once, and each query looks through those: fewer reads, the same answer. What is known \
         is carried from one group to the next, which ends with its block of the stream, as of --carry.",
    )
    .or("1")
    .hidden();

pm_registry::registered! {
    /// Tree of sixteen boxes a node and sixteen photons a leaf, searched side by side: the fast one
    pub struct Wide = "wide" with [GROUP];
}

impl Structure for Wide {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--group 32"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        Ok(Box::new(WideTree::build(setting.photons)?.in_groups_of(setting.values.count(GROUP.name))))
    }
}
