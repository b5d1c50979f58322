//! Errors of inputs in other programs' formats (exit code 3, like damage to a stream of ours).

use std::fmt;

/// An input does not hold what its format demands (exit code 3).
#[derive(Debug)]
pub struct BadInput(String);

impl BadInput {
    /// The error that says so, for instance for an `io::Error` of a reader that decompresses.
    pub fn new(text: impl Into<String>) -> Self {
        Self(text.into())
    }
}

impl fmt::Display for BadInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for BadInput {}

/// An error that says what is wrong with an input.
pub fn bad_input(text: impl Into<String>) -> anyhow::Error {
    BadInput::new(text).into()
}
