//! No structure of the photons: one of the queries.

use crate::{AnyMap, BuildError, Candidates, ReverseMap, Setting, Structure};
use pm_registry::{Domain, Parameter, words_of};

const BATCH: Parameter = Parameter::new(
    "batch",
    Domain::count(1, 4096),
    "queries that are indexed on chip at a time, and for which all photons are read once",
)
.or("1024")
.hidden();
const CANDIDATES: Parameter = Parameter::new(
    "candidates",
    Domain::Word(words_of::<Candidates>),
    "where the k candidates of each query of a batch are kept",
)
.called("WHERE")
.or("chip")
.hidden();

pm_registry::registered! {
    /// Reverse photon mapping (Havran, Herzog, Seidel): the queries of a batch are indexed, and the photons stream by
    pub struct Reverse = "reverse" with [BATCH, CANDIDATES];
}

impl Structure for Reverse {
    fn forms(&self) -> &'static [&'static str] {
        &["", "--batch 7 --line 32", "--candidates memory --line 320"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        let (batch, candidates) = (setting.values.count(BATCH.name), setting.values.choice(CANDIDATES.name));
        Ok(Box::new(ReverseMap::build(setting.photons, setting.line(), batch, (setting.k, candidates))?))
    }
}
