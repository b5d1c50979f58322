//! Hash tables over the photons' blocks.

use super::SLOTS;
use crate::{AnyMap, BlockHashOptions, BuildError, Orphans, Setting, Structure};
use pm_registry::{Domain, Parameter, words_of};

const TABLES: Parameter =
    Parameter::new("tables", Domain::count(1, 1000), "number of tables, L [default: ln N, 4 to 16]")
        .called("L")
        .hidden();
const THRESHOLDS: Parameter = Parameter::new(
    "thresholds",
    Domain::count(1, 1000),
    "thresholds along each axis, P [default: cells on a wall fill half a bucket, 4 to 64]",
)
.called("P")
.hidden();
const BUDGET: Parameter =
    Parameter::new("budget", Domain::count(1, 1 << 20), "photons read for each that is wanted, A")
        .called("A")
        .or("20")
        .hidden();
const ORPHANS: Parameter =
    Parameter::new("orphans", Domain::Word(words_of::<Orphans>), "what becomes of blocks that no bucket has room for")
        .called("ORPHANS")
        .or("keep")
        .hidden();

pm_registry::registered! {
    /// Block hashing (Ma and McCool): approximate
    pub struct BlockHash = "block-hash" with [
        TABLES,
        THRESHOLDS,
        Parameter { help: "references in a bucket [default: a line's worth]", ..SLOTS },
        BUDGET,
        ORPHANS,
    ];
}

impl Structure for BlockHash {
    fn is_exact(&self) -> bool {
        false
    }

    fn forms(&self) -> &'static [&'static str] {
        &["", "--line 32", "--line 320 --budget 3", "--orphans repair --slots 2 --tables 6 --thresholds 10"]
    }

    fn described_by(&self) -> &'static [&'static str] {
        &[BUDGET.name, ORPHANS.name]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn AnyMap>, BuildError> {
        let values = setting.values;
        let options = BlockHashOptions {
            line: setting.line(),
            tables: values.count_if_any(TABLES.name),
            thresholds: values.count_if_any(THRESHOLDS.name),
            slots: values.count_if_any(SLOTS.name),
            budget: values.count(BUDGET.name),
            orphans: values.choice(ORPHANS.name),
            seed: 0,
        };
        Ok(Box::new(crate::BlockHash::build(setting.photons, options)?))
    }
}
