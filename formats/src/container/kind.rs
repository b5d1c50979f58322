//! What streams hold.

use serde::{Deserialize, Serialize};

/// What the records of a stream are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u16)]
pub enum StreamKind {
    /// Photons, 20 bytes each.
    Photons = 1,
    /// Gather queries, 44 bytes each.
    Queries = 2,
    /// Searches with the accesses they made.
    Trace = 3,
    /// Photons of a part of a stream, 32 bytes each: their powers are rounded when the parts are put together.
    UnroundedPhotons = 4,
}

impl StreamKind {
    /// The kind with this number, if there is one.
    #[must_use]
    pub const fn from_number(number: u16) -> Option<Self> {
        match number {
            1 => Some(Self::Photons),
            2 => Some(Self::Queries),
            3 => Some(Self::Trace),
            4 => Some(Self::UnroundedPhotons),
            _ => None,
        }
    }

    /// What the stream holds, in the plural, for people.
    #[must_use]
    pub const fn plural(self) -> &'static str {
        match self {
            Self::Photons => "photons",
            Self::Queries => "queries",
            Self::Trace => "searches (a trace)",
            Self::UnroundedPhotons => "photons of a part (to be put together by pm-view --merge)",
        }
    }
}
