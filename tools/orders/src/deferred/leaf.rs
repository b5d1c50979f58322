//! Leaf by leaf of a tree over the photons.

use super::parameters::{LEAF_PHOTONS, PHOTONS};
use crate::{Charge, MedianSplit, Order, Reorder, Setting};
use pm_formats::Query;
use pm_registry::ParameterError;

pm_registry::registered! {
    /// By leaf of a median split of the photons, depth first
    pub struct Leaf = "leaf" with [PHOTONS.needed(), LEAF_PHOTONS.or("64")];
}

impl Order for Leaf {
    fn forms(&self) -> &'static [&'static str] {
        &["--photons map.pmp", "--photons map.pmp --leaf-photons 7"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        Ok(by_cell(setting, |_| Charge::MergeSort))
    }
}

/// Sorted by the number of the cell; `charge` may depend on how many cells there are.
pub(super) fn by_cell(mut setting: Setting<'_>, charge: impl FnOnce(u64) -> Charge) -> Box<dyn Reorder> {
    let photons = setting.photons.take().unwrap_or_default();
    let cells = MedianSplit::new(photons, setting.values.count(LEAF_PHOTONS.name));
    let (charge, tables) = (charge(cells.cells().into()), cells.bytes());
    let keys = move |queries: &[Query]| queries.iter().map(|query| cells.cell(query.position)).collect();
    setting.sort(Box::new(keys), charge, tables)
}
