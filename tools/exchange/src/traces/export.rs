//! What a format of traces is to those who write it.

use super::Piece;
use pm_registry::Registered;
use std::io::{self, Write};

/// A format of traces that is written: an entry of [`exports`](super::exports).
pub trait TraceExport: Registered + Sync {
    /// Is it text?
    fn is_text(&self) -> bool;

    /// What its entries say of an access, besides where it is.
    fn carried(&self) -> Carried;

    /// What writes one trace.
    ///
    /// # Errors
    /// If it needs a temporary file and cannot have one.
    fn writer(&self) -> io::Result<Box<dyn PieceWriter>>;
}

/// Writes the entries of one trace, in their order.
pub trait PieceWriter {
    /// Writes what stands before the first entry.
    ///
    /// # Errors
    /// What `output` reports.
    fn begin(&mut self, output: &mut dyn Write) -> io::Result<()> {
        let _ = output;
        Ok(())
    }

    /// Writes an entry.
    ///
    /// # Errors
    /// If it cannot be said, or not be written.
    fn write(&mut self, piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten>;

    /// Writes what could not be written before the end.
    ///
    /// # Errors
    /// What `output` reports.
    fn finish(&mut self, output: &mut dyn Write) -> io::Result<()> {
        let _ = output;
        Ok(())
    }
}

impl<F: FnMut(&Piece, &mut dyn Write) -> Result<(), Unwritten>> PieceWriter for F {
    fn write(&mut self, piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
        self(piece, output)
    }
}

/// What entries say of an access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Carried {
    /// How many bytes it touches, so that the part of a line need not stand for the line.
    pub sizes: bool,
    /// What is done.
    pub kinds: Kinds,
}

/// Which kinds of access a format tells apart. A writer is given no others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kinds {
    /// None: it gets every access as a read.
    None,
    /// Reads and writes: an access that does both is a read and then a write.
    ReadsAndWrites,
    /// All three.
    All,
}

/// Why an entry was not written.
#[derive(Debug)]
pub enum Unwritten {
    /// The format has no room for such an address or such a size.
    DoesNotFit,
    /// The output refused.
    Output(io::Error),
    /// A temporary file refused.
    TemporaryFile(io::Error),
}

impl From<io::Error> for Unwritten {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}
