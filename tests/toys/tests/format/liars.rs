//! Toy formats that are not what they say, for the generic tests to find.

use pm_exchange::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, EntryShape, Example, Kinds, Parsed, Piece, PieceWriter, Recognition,
    Reference, TraceExport, TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// Says that its entries are longer than they are
    pub struct Boasts = "boasts";
}

pm_registry::registered! {
    /// Takes whatever comes for its own
    pub struct Grabs = "grabs";
}

pm_registry::registered! {
    /// Forgets to write what is written
    pub struct Forgets = "arrows";
}

const AT_8: Reference = Reference { kind: EntryKind::READ, address: 8, len: None };

impl TraceImport for Boasts {
    fn shape(&self) -> EntryShape {
        EntryShape::Record { bytes: 1 }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(|record: &[u8]| -> Parsed { Ok(Some(Reference { address: record[0].into(), ..AT_8 })) })
    }

    fn example(&self) -> Example {
        const SIZED: Reference = Reference { len: Some(9), ..AT_8 };
        Example { input: &[8, 8], entries: &[SIZED, SIZED] }
    }
}

impl TraceImport for Grabs {
    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize::BYTE)
    }

    fn recognition(&self) -> Recognition {
        Recognition::FirstLine
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(|_: &[u8]| -> Parsed { Ok(Some(AT_8)) })
    }

    fn example(&self) -> Example {
        Example { input: b"8\n8\n", entries: &[AT_8, AT_8] }
    }
}

impl TraceExport for Forgets {
    fn is_text(&self) -> bool {
        true
    }

    fn carried(&self) -> Carried {
        Carried { sizes: true, kinds: Kinds::ReadsAndWrites }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(|piece: &Piece, output: &mut dyn Write| -> Result<(), Unwritten> {
            match piece.is_write() {
                true => Ok(()),
                false => Ok(writeln!(output, "<{:x} {}", piece.address, piece.len)?),
            }
        }))
    }
}
