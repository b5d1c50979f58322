//! `ramulator2`: loads and stores for the simulator of memories of that name, such as `LD 0x1000`.

use crate::traces::text::{number, quoted, words};
use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, Example, Kinds, Parsed, Piece, PieceWriter, Reference, TraceExport,
    TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// Ramulator 2: LD or ST and address, such as LD 0x1000
    pub struct Ramulator2 = "ramulator2";
}

fn parse(line: &[u8]) -> Parsed {
    let wrong = || format!("{} is not LD or ST and an address", quoted(line));
    let [kind, address] = words(line).collect::<Vec<_>>()[..] else { return Err(wrong()) };
    let kind = match kind {
        b"LD" => EntryKind::READ,
        b"ST" => EntryKind::WRITE,
        _ => return Err(wrong()),
    };
    Ok(Some(Reference { kind, address: number(address)?, len: None }))
}

impl TraceImport for Ramulator2 {
    fn assumed_size(&self) -> Option<AssumedSize> {
        // What a memory transfers at once.
        Some(AssumedSize::bytes(64))
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"LD 0x1000\nST 64\n",
            entries: &[
                Reference { kind: EntryKind::READ, address: 4096, len: None },
                Reference { kind: EntryKind::WRITE, address: 64, len: None },
            ],
        }
    }
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    Ok(writeln!(output, "{} {:#x}", if piece.is_write() { "ST" } else { "LD" }, piece.address)?)
}

impl TraceExport for Ramulator2 {
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
