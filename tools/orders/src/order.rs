//! What a deferred order is to those who choose one by its word.

use super::{Charge, Limits, Reorder, Sorted, Store};
use pm_formats::{Bounds, Query};
use pm_registry::{ParameterError, Registered, Values};

/// A deferred order, as it stands in a registry. Parameters that are files name streams of photons.
pub trait Order: Registered + Sync {
    /// Its name in tables: the word, with what else its result depends on.
    fn label(&self, values: &Values, store: Store) -> String {
        let _ = (values, store);
        self.word().to_owned()
    }

    /// Do queries leave before all have come, so that a longer stream needs no larger store?
    fn is_streaming(&self) -> bool {
        false
    }

    /// Options under which tests try it, each a line, the first for tests of one; a file of photons is called `map.pmp`.
    fn forms(&self) -> &'static [&'static str] {
        &[""]
    }

    /// The order at work.
    ///
    /// # Errors
    /// If the values that were given do not go together, or not with the scene.
    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError>;
}

/// What an order works with.
pub struct Setting<'a> {
    /// What was said to the order.
    pub values: &'a Values,
    /// Bounds of the scene.
    pub bounds: Bounds,
    /// The store on chip.
    pub store: Store,
    /// Where the photons are that it was given, if it was given a file of them.
    pub photons: Option<Vec<[f32; 3]>>,
    /// What this machine may spend.
    pub limits: Limits,
}

/// Computes the keys of many queries at once.
pub type Keys = Box<dyn Fn(&[Query]) -> Vec<u32>>;

impl Setting<'_> {
    /// An order by these keys that holds all of a batch or an image; `tables` are the bytes that they take on chip.
    #[must_use]
    pub fn sort(self, keys: Keys, charge: Charge, tables: u64) -> Box<dyn Reorder> {
        Box::new(Sorted::new(keys, charge, self.store, tables, self.limits))
    }
}
