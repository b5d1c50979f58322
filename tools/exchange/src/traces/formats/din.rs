//! `din`, the text format of Dinero III and IV.
//!
//! Dinero takes the address of a line for that of a word of four bytes. Whatever follows on a line is a comment.
//! Copy-backs and invalidations are instructions to a cache, not accesses, and refused.

use crate::traces::text::{hexadecimal, quoted, words};
use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, Example, Kinds, Parsed, Piece, PieceWriter, Reference, TraceExport,
    TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// Dinero III and IV: label (0 read, 1 write, 2 instruction, 3 other) and address, hexadecimal
    pub struct Din = "din";
}

/// The kind by its number, which `dinb` has too.
pub(super) fn kind(label: u64) -> Result<EntryKind, String> {
    match label {
        0 | 3 => Ok(EntryKind::READ),
        1 => Ok(EntryKind::WRITE),
        2 => Ok(EntryKind::Instruction),
        4 | 5 => Err(format!("label {label} tells a cache to copy back or to forget, which is not simulated")),
        _ => Err(format!("label {label} is none of 0 (read), 1 (write), 2 (instruction), 3 (other)")),
    }
}

fn parse(line: &[u8]) -> Parsed {
    let mut words = words(line);
    let (Some(label), Some(address)) = (words.next(), words.next()) else {
        return Err(format!("{} is not a label and an address", quoted(line)));
    };
    let kind = kind(hexadecimal(label)?)?;
    Ok(Some(Reference { kind, address: hexadecimal(address)?, len: None }))
}

impl TraceImport for Din {
    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize { bytes: 4, aligned: true })
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"0 1003 first\n1 0xABC\n2 40\n3 7",
            entries: &[
                Reference { kind: EntryKind::READ, address: 0x1003, len: None },
                Reference { kind: EntryKind::WRITE, address: 0xabc, len: None },
                Reference { kind: EntryKind::Instruction, address: 0x40, len: None },
                Reference { kind: EntryKind::READ, address: 7, len: None },
            ],
        }
    }
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    Ok(writeln!(output, "{} {:x}", u8::from(piece.is_write()), piece.address)?)
}

impl TraceExport for Din {
    fn is_text(&self) -> bool {
        true
    }

    fn carried(&self) -> Carried {
        Carried { sizes: false, kinds: Kinds::ReadsAndWrites }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(write))
    }
}
