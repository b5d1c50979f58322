//! Along a Hilbert curve, spilled once.

use super::hilbert;
use crate::partitions::Partitions;
use crate::{Charge, Order, Reorder, Setting, Store};
use pm_registry::{ParameterError, Values};
use pm_size::Bytes;

pm_registry::registered! {
    /// Along a Hilbert curve: spilled in partitions that fit the store, and sorted when they are read back
    pub struct Partition = "partition";
}

impl Order for Partition {
    fn label(&self, _: &Values, store: Store) -> String {
        format!("partition {}", Bytes(store.bytes))
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let keys = hilbert::keys(setting.bounds);
        Ok(setting.sort(Box::new(keys), Charge::Partitions(Partitions::new()), 0))
    }
}
