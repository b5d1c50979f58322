//! Which derivations there are: a line each.

use crate::Derivation;
use pm_registry::Registry;

/// All derivations.
#[must_use]
pub fn derivations() -> Registry<Derivation> {
    Registry::new(
        "derivation",
        &[
            &crate::accuracy::ACCURACY,
            &crate::batches::BATCHES,
            &crate::budget::BUDGET,
            &crate::cheapest::CHEAPEST,
            &crate::claims::CLAIMS,
            &crate::compare::COMPARE,
            &crate::coverage::COVERAGE,
            &crate::exact::EXACT,
            &crate::flux::FLUX,
            &crate::frontier::FRONTIER,
            &crate::lattice::LATTICE,
            &crate::least::LEAST,
            &crate::mean::MEAN,
            &crate::powers::POWERS,
            &crate::regions::REGIONS,
            &crate::sampled::SAMPLED,
            &crate::structures::STRUCTURES,
            &crate::table1::TABLE_1,
            &crate::traffic::TRAFFIC,
        ],
    )
}
