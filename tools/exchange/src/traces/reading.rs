//! How an input is to be read.

use super::{Part, TraceImport};

/// How an input is to be read.
#[derive(Clone)]
pub struct Reading {
    /// Its format; `None`: as its content tells.
    pub format: Option<&'static dyn TraceImport>,
    /// Bytes of every access, whatever the entries say; `None`: as they say, or as the format assumes.
    pub access_size: Option<u32>,
    /// Bytes that one unit of an address stands for.
    pub address_unit: u64,
    /// Names of the columns of a file without names.
    pub columns: Option<Vec<String>>,
    /// Which entries count.
    pub references: References,
    /// Which of the accesses are replayed.
    pub part: Part,
}

impl Reading {
    /// As the content tells, and data alone.
    #[must_use]
    pub const fn plain() -> Self {
        Self {
            format: None,
            access_size: None,
            address_unit: 1,
            columns: None,
            references: References::Data,
            part: Part { skip: 0, warm_up: 0, take: None },
        }
    }

    /// The same for inputs of this format.
    #[must_use]
    pub fn of(self, format: &'static dyn TraceImport) -> Self {
        Self { format: Some(format), ..self }
    }
}

pm_registry::choices! {
    /// Which entries of a trace that has instructions too.
    #[derive(Debug)]
    pub enum References {
        /// Data alone
        Data = "data",
        /// Instructions alone
        Instructions = "instructions",
        /// Data and instructions
        All = "all",
    }
}
