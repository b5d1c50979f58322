//! Where a value is from: a column of a row of a sheet.

use crate::sheet::Sheet;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// A column of a row of a sheet.
#[derive(Clone, Debug)]
pub struct Place {
    /// As it was asked for, such as `row('t.csv', order='scanline')`.
    pub(super) asked: String,
    pub(super) sheet: Arc<Sheet>,
    pub(super) row: usize,
    pub(super) column: usize,
}

impl Place {
    /// What stands there.
    #[must_use]
    pub fn field(&self) -> &str {
        &self.sheet.rows()[self.row][self.column]
    }

    /// What stands in another column of its row, if there is one of this name.
    #[must_use]
    pub fn beside(&self, column: &str) -> Option<&str> {
        self.sheet.find(column).map(|at| &self.sheet.rows()[self.row][at])
    }

    /// The name of its column.
    #[must_use]
    pub fn column(&self) -> &str {
        &self.sheet.columns()[self.column]
    }
}

impl PartialEq for Place {
    fn eq(&self, other: &Self) -> bool {
        (&self.asked, self.row, self.column) == (&other.asked, other.row, other.column)
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.asked, self.column())
    }
}

/// The places that the evaluation under way has looked up.
#[derive(Clone, Debug, Default)]
pub(super) struct Places(Arc<Mutex<Vec<Place>>>);

impl Places {
    pub(super) fn clear(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clear();
    }

    pub(super) fn add(&self, place: Place) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(place);
    }

    pub(super) fn taken(&self) -> Vec<Place> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}
