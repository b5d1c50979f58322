//! What an entry of a foreign trace says.

use pm_formats::trace::AccessKind;

/// Longest access that an entry may tell of, in bytes: whoever reads a format as another meets longer ones soon.
pub(super) const LONGEST_ACCESS: u32 = pm_formats::trace::MAX_ACCESS;

/// What an entry does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// Data are accessed.
    Data(AccessKind),
    /// An instruction is read.
    Instruction,
}

impl EntryKind {
    /// Data are read.
    pub const READ: Self = Self::Data(AccessKind::Read);
    /// Data are written.
    pub const WRITE: Self = Self::Data(AccessKind::Write);
    /// Data are read and written by one access.
    pub const MODIFY: Self = Self::Data(AccessKind::ReadModifyWrite);
}

/// An entry of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reference {
    /// What it does.
    pub kind: EntryKind,
    /// Its first byte, in units of an address ([`Reading::address_unit`](super::Reading::address_unit)).
    pub address: u64,
    /// Bytes, if the entry says.
    pub len: Option<u32>,
}

/// An entry, and which of the input's lines or records it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numbered {
    /// Counted from 1.
    pub number: u64,
    /// What it says.
    pub reference: Reference,
}

/// An entry, nothing (a comment), or what is wrong with it.
pub type Parsed = Result<Option<Reference>, String>;
