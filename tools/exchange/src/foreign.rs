//! Traces in other simulators' formats, read and written.
//!
//! A format is a file here that knows what one entry looks like, and a line in [`Form`]. Reading makes a [`Trace`], which
//! replays into the same sinks as a trace of ours; writing is an [`Exporter`], itself such a sink. What a foreign trace does
//! not have: searches, so nothing is per query, and regions: these are the 4 KiB pages it touches, at their addresses.

mod csv;
mod din;
mod dinb;
mod dram;
mod entries;
mod export;
mod lackey;
mod numbers;
mod open;
mod oracle_general;
mod pages;
mod raw;
mod trace;
mod unpack;

pub use export::{Exporter, Piece};
pub use open::{Opened, Reading, References, open};
pub use trace::Trace;

use pm_formats::trace::AccessKind;

pm_registry::choices! {
    /// A format of traces. Addresses are bytes, numbers little-endian; a modify is an access that reads and writes.
    #[derive(Debug)]
    pub enum Form {
        /// Addresses of 32 bits, little-endian
        Raw32 = "raw32",
        /// Addresses of 64 bits, little-endian
        Raw64 = "raw64",
        /// Dinero III and IV: label (0 read, 1 write, 2 instruction, 3 other) and address, hexadecimal
        Din = "din",
        /// Dinero IV extended: r, w, i or m, address and size, hexadecimal
        Xdin = "xdin",
        /// Dinero IV binary: 8 bytes an access
        Dinb = "dinb",
        /// valgrind --tool=lackey --trace-mem=yes
        Lackey = "lackey",
        /// libCacheSim, 24 bytes a request
        OracleGeneral = "oracleGeneral" | "oracle-general",
        /// Columns address, size, kind
        Csv = "csv",
        /// DRAMsim3: address, READ or WRITE, cycle
        Dramsim3 = "dramsim3",
        /// Ramulator 2: LD or ST and address
        Ramulator2 = "ramulator2",
    }
}

impl Form {
    /// Whether it is text.
    #[must_use]
    pub fn is_text(self) -> bool {
        !matches!(self, Self::Raw32 | Self::Raw64 | Self::Dinb | Self::OracleGeneral)
    }

    /// Bytes of an access whose entry does not say: the word that Dinero takes, the transaction of a memory, or the byte
    /// at the address.
    fn size(self) -> u32 {
        match self {
            Self::Din => 4,
            Self::Dramsim3 | Self::Ramulator2 => 64,
            _ => 1,
        }
    }
}

/// Forms that tell themselves by their first line, more peculiar ones first.
const TOLD_BY_CONTENT: [Form; 6] = [Form::Lackey, Form::Xdin, Form::Din, Form::Dramsim3, Form::Ramulator2, Form::Csv];

/// What an entry does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Data(AccessKind),
    /// An instruction is read.
    Instruction,
}

const READ: Kind = Kind::Data(AccessKind::Read);
const WRITE: Kind = Kind::Data(AccessKind::Write);
const MODIFY: Kind = Kind::Data(AccessKind::ReadModifyWrite);

/// An entry of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Reference {
    kind: Kind,
    address: u64,
    /// Bytes, if the format says.
    len: Option<u32>,
}

/// An entry, nothing (a comment), or what is wrong with it.
type Parsed = Result<Option<Reference>, String>;

#[cfg(test)]
mod tests;
