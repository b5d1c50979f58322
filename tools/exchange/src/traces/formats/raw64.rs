//! Bare addresses of 64 bits, little-endian.

use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, EntryShape, Example, Kinds, Parsed, Piece, PieceWriter, Reference,
    TraceExport, TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// Addresses of 64 bits, little-endian
    pub struct Raw64 = "raw64";
}

const fn read(address: u64) -> Reference {
    Reference { kind: EntryKind::READ, address, len: None }
}

fn parse(record: &[u8]) -> Parsed {
    Ok(Some(read(u64::from_le_bytes(record.try_into().expect("eight bytes")))))
}

impl TraceImport for Raw64 {
    fn shape(&self) -> EntryShape {
        EntryShape::Record { bytes: 8 }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize::BYTE)
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: &[0, 16, 0, 0, 255, 255, 255, 255, 7, 0, 0, 0, 0, 0, 0, 0],
            entries: const { &[read(0xffff_ffff_0000_1000), read(7)] },
        }
    }
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    Ok(output.write_all(&piece.address.to_le_bytes())?)
}

impl TraceExport for Raw64 {
    fn is_text(&self) -> bool {
        false
    }

    fn carried(&self) -> Carried {
        Carried { sizes: false, kinds: Kinds::None }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(write))
    }
}
