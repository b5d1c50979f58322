//! Bare addresses of 32 bits, little-endian.

use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, EntryShape, Example, Kinds, Parsed, Piece, PieceWriter, Reference,
    TraceExport, TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// Addresses of 32 bits, little-endian
    pub struct Raw32 = "raw32";
}

const fn read(address: u32) -> Reference {
    Reference { kind: EntryKind::READ, address: address as u64, len: None }
}

fn parse(record: &[u8]) -> Parsed {
    Ok(Some(read(u32::from_le_bytes(record.try_into().expect("four bytes")))))
}

impl TraceImport for Raw32 {
    fn shape(&self) -> EntryShape {
        EntryShape::Record { bytes: 4 }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize::BYTE)
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example { input: &[0, 16, 0, 0, 255, 255, 255, 255], entries: const { &[read(4096), read(u32::MAX)] } }
    }
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    let address = u32::try_from(piece.address).map_err(|_| Unwritten::DoesNotFit)?;
    Ok(output.write_all(&address.to_le_bytes())?)
}

impl TraceExport for Raw32 {
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
