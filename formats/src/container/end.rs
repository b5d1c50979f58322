//! The end block: proof that a stream is whole, and what each stage measured.

use crate::digest::Tally;
use serde::{Deserialize, Serialize};

/// A number that a stage measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Number {
    /// A count.
    Count(u64),
    /// Bytes.
    Bytes(u64),
    /// Anything else; the name says the unit.
    Real(f64),
}

impl Number {
    /// The number, whatever it counts.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "counts beyond 2^53 are shown, not computed with")]
    pub const fn as_f64(self) -> f64 {
        match self {
            Self::Count(n) | Self::Bytes(n) => n as f64,
            Self::Real(x) => x,
        }
    }
}

/// What one program measured while it worked on the stream.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageReport {
    /// The program.
    pub program: String,
    /// Names and numbers, in the order they are to be shown.
    pub measures: Vec<(String, Number)>,
}

impl StageReport {
    /// A report of `program` with nothing in it yet.
    #[must_use]
    pub fn new(program: &str) -> Self {
        Self { program: program.to_owned(), measures: vec![] }
    }

    /// Adds a number.
    #[must_use]
    pub fn with(mut self, name: &str, number: Number) -> Self {
        self.measures.push((name.to_owned(), number));
        self
    }
}

/// The end of a whole stream.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// Number and digest of all records.
    pub tally: Tally,
    /// What each stage measured, first stage first.
    pub stages: Vec<StageReport>,
}

/// An end block as it is spelled since it proves the order of what stands before it.
#[derive(Serialize, Deserialize)]
pub(super) struct SealedEnd {
    pub(super) end: End,
    pub(super) order: u64,
}

impl End {
    /// The latest number measured under this name.
    #[must_use]
    pub fn measure(&self, name: &str) -> Option<Number> {
        let measures = self.stages.iter().rev().flat_map(|stage| &stage.measures);
        measures.into_iter().find(|(known, _)| known == name).map(|&(_, number)| number)
    }
}
