//! A toy format that is only written: addresses, very loud.

use pm_exchange::traces::{Carried, Kinds, Piece, PieceWriter, TraceExport, Unwritten};
use std::io::{self, Write};

pm_registry::registered! {
    /// Addresses, very loud
    pub struct Shouts = "shouts";
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    Ok(writeln!(output, "{:#X}!", piece.address)?)
}

impl TraceExport for Shouts {
    fn is_text(&self) -> bool {
        true
    }

    fn carried(&self) -> Carried {
        Carried { sizes: false, kinds: Kinds::None }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(write))
    }
}
