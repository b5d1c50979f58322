//! `dinb`, the binary format of Dinero IV: address u32, size u16, label u8 as in `din`, and a byte that says nothing.

use super::din;
use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, EntryShape, Example, Kinds, Parsed, Piece, PieceWriter, Reference,
    TraceExport, TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// Dinero IV binary: 8 bytes an access
    pub struct Dinb = "dinb";
}

/// Bytes of a record.
const BYTES: usize = 8;

fn parse(record: &[u8]) -> Parsed {
    Ok(Some(Reference {
        kind: din::kind(record[6].into())?,
        address: u32::from_le_bytes(record[..4].try_into().expect("four bytes")).into(),
        len: Some(u16::from_le_bytes([record[4], record[5]]).into()),
    }))
}

impl TraceImport for Dinb {
    fn shape(&self) -> EntryShape {
        EntryShape::Record { bytes: BYTES }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: &[3, 16, 0, 0, 20, 1, 1, 0, 64, 0, 0, 0, 4, 0, 2, 0],
            entries: &[
                Reference { kind: EntryKind::WRITE, address: 0x1003, len: Some(276) },
                Reference { kind: EntryKind::Instruction, address: 64, len: Some(4) },
            ],
        }
    }
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    let address = u32::try_from(piece.address).map_err(|_| Unwritten::DoesNotFit)?;
    let len = u16::try_from(piece.len).map_err(|_| Unwritten::DoesNotFit)?;
    let mut record = [0; BYTES];
    record[..4].copy_from_slice(&address.to_le_bytes());
    record[4..6].copy_from_slice(&len.to_le_bytes());
    record[6] = piece.is_write().into();
    Ok(output.write_all(&record)?)
}

impl TraceExport for Dinb {
    fn is_text(&self) -> bool {
        false
    }

    fn carried(&self) -> Carried {
        Carried { sizes: true, kinds: Kinds::ReadsAndWrites }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(write))
    }
}
