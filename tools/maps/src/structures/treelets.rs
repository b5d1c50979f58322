//! The kd-tree in pieces, at which the searches of a batch wait.

use crate::{AnyMap, BuildError, Setting, Structure, TreeletOptions, Treelets, Waiting};
use pm_registry::{Domain, Parameter, words_of};

const TREELET: Parameter =
    Parameter::new("treelet", Domain::count(20, 1 << 30), "bytes that a treelet has at most, nodes of 20 bytes each")
        .called("BYTES")
        .or("65536")
        .hidden();
const BATCH: Parameter =
    Parameter::new("batch", Domain::count(1, 4096), "searches that are under way at a time").or("4096").hidden();
const WAITING: Parameter =
    Parameter::new("waiting", Domain::Word(words_of::<Waiting>), "where searches wait for their treelet")
        .called("WHERE")
        .or("memory")
        .hidden();

pm_registry::registered! {
    /// kd-tree in treelets with queues (Aila and Karras): a search that leaves a treelet waits until its next one is in the cache
    pub struct InTreelets = "treelets" with [TREELET, BATCH, WAITING];
}

impl Structure for InTreelets {
    fn forms(&self) -> &'static [&'static str] {
        &["--treelet 8192", "--treelet 20 --batch 7 --waiting chip", "--treelet 300 --line 32", ""]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        let values = setting.values;
        let options = TreeletOptions {
            treelet: values.count(TREELET.name),
            batch: values.count(BATCH.name),
            waiting: values.choice(WAITING.name),
            line: setting.line(),
            k: setting.k,
        };
        Ok(Box::new(Treelets::build(setting.photons, options)?))
    }
}
