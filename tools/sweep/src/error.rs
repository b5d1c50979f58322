//! What is wrong with a table, and where; what is wrong with rows.

use thiserror::Error;

/// A table that is not understood, or understood to be a mistake.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{file}:{line}: {what}")]
pub struct TableError {
    /// The table's name.
    pub file: String,
    /// The line, counted from 1.
    pub line: u64,
    /// What is wrong with it and what to do.
    pub what: String,
}

/// Rows that cannot be believed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{file}: {what}")]
pub struct SweepError {
    /// The file of rows.
    pub file: String,
    /// What is wrong with it and what to do.
    pub what: String,
}

impl SweepError {
    /// An error of a file of rows.
    pub(crate) fn new(file: &str, what: impl Into<String>) -> Self {
        Self { file: file.into(), what: what.into() }
    }
}
