//! An entry of a registry and what it was asked.

use crate::{Registered, Values};
use std::fmt;

/// The entry that was chosen, with a value for each of its parameters.
pub struct Chosen<T: ?Sized + 'static> {
    /// The entry.
    pub entry: &'static T,
    /// Its parameters, and those that are common to all.
    pub values: Values,
}

impl<T: ?Sized> Clone for Chosen<T> {
    fn clone(&self) -> Self {
        Self { entry: self.entry, values: self.values.clone() }
    }
}

impl<T: Registered + ?Sized> fmt::Debug for Chosen<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Chosen").field("entry", &self.entry.word()).field("values", &self.values).finish()
    }
}
