//! Along a Hilbert curve through the scene.

use crate::{Charge, Order, Reorder, Setting};
use pm_curves::hilbert_keys;
use pm_formats::{Bounds, Query};
use pm_registry::ParameterError;

pm_registry::registered! {
    /// Along a Hilbert curve through the scene (30-bit keys)
    pub struct Hilbert = "hilbert";
}

/// Keys along the curve.
pub(super) fn keys(bounds: Bounds) -> impl Fn(&[Query]) -> Vec<u32> {
    move |queries| hilbert_keys(&bounds, queries, |query| query.position)
}

impl Order for Hilbert {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let keys = keys(setting.bounds);
        Ok(setting.sort(Box::new(keys), Charge::MergeSort, 0))
    }
}
