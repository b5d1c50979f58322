//! Whose fault it is: an input that does not hold what its format demands, or a question that makes no sense.

use std::fmt;

/// An input does not hold what its format demands.
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

/// What was asked makes no sense, whatever the input holds.
#[derive(Debug)]
pub struct BadQuestion(String);

impl BadQuestion {
    /// The error that says so.
    pub fn new(text: impl Into<String>) -> Self {
        Self(text.into())
    }
}

impl fmt::Display for BadQuestion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for BadQuestion {}

/// An error that says what is wrong with what was asked.
pub(crate) fn bad_question(text: impl Into<String>) -> anyhow::Error {
    BadQuestion::new(text).into()
}
