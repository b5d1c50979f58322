//! Why no report comes of what was asked.

use thiserror::Error;

/// Why there is no page, chart or number: which file, where there is one which line, and whose fault it is.
#[derive(Clone, Debug, Error)]
#[error("{}{what}", .line.map_or(String::new(), |line| format!("line {line}: ")))]
pub struct ReportError {
    /// The line of the description, the first being 1.
    line: Option<usize>,
    what: String,
    asked_wrongly: bool,
}

impl ReportError {
    /// Something is asked for that cannot be.
    #[must_use]
    pub fn asked(what: impl Into<String>) -> Self {
        Self { line: None, what: what.into(), asked_wrongly: true }
    }

    /// A file cannot be read, or does not hold what it should.
    #[must_use]
    pub fn read(what: impl Into<String>) -> Self {
        Self { asked_wrongly: false, ..Self::asked(what) }
    }

    /// The same, at this line of the description unless its place is known better.
    #[must_use]
    pub fn at_line(self, line: Option<usize>) -> Self {
        Self { line: self.line.or(line), ..self }
    }

    /// The same, with what it was found in.
    #[must_use]
    pub(crate) fn inside(self, place: &str) -> Self {
        Self { what: format!("in {place}: {}", self.what), ..self }
    }

    /// Is it the one who asks that is wrong, and not a file that is named?
    #[must_use]
    pub const fn asked_wrongly(&self) -> bool {
        self.asked_wrongly
    }
}
