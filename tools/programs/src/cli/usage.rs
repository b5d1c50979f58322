//! Errors of the person who asks (exit code 2).

use std::fmt;

/// The program was asked wrongly (exit code 2).
#[derive(Debug)]
pub struct UsageError(String);

impl fmt::Display for UsageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for UsageError {}

/// What was asked for cannot be had, whatever is done (exit code 4).
#[derive(Debug)]
pub struct Refusal(String);

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Refusal {}

/// An error that says that nothing fits.
pub fn refusal(text: impl Into<String>) -> anyhow::Error {
    Refusal(text.into()).into()
}

/// An error that says the program was asked wrongly.
pub fn usage(text: impl Into<String>) -> anyhow::Error {
    UsageError(text.into()).into()
}
