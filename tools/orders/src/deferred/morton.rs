//! Along Morton's curve through the scene.

use crate::{Charge, Order, Reorder, Setting};
use pm_curves::morton_keys;
use pm_formats::Query;
use pm_registry::ParameterError;

pm_registry::registered! {
    /// Along Morton's curve (30-bit keys)
    pub struct Morton = "morton";
}

impl Order for Morton {
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let bounds = setting.bounds;
        let keys = move |queries: &[Query]| morton_keys(&bounds, queries, |query| query.position);
        Ok(setting.sort(Box::new(keys), Charge::MergeSort, 0))
    }
}
