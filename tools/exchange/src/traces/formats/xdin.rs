//! `xdin`, the extended text format of Dinero IV. Whatever follows on a line is a comment.

use crate::traces::text::{hexadecimal, quoted, size, words};
use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, Example, Kinds, Parsed, Piece, PieceWriter, Reference, TraceExport,
    TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// Dinero IV extended: r, w, i or m, address and size, hexadecimal
    pub struct Xdin = "xdin";
}

fn parse(line: &[u8]) -> Parsed {
    let mut words = words(line);
    let (Some(label), Some(address), Some(len)) = (words.next(), words.next(), words.next()) else {
        return Err(format!("{} is not a label, an address and a size", quoted(line)));
    };
    let kind = match label {
        b"r" | b"m" => EntryKind::READ,
        b"w" => EntryKind::WRITE,
        b"i" => EntryKind::Instruction,
        b"c" | b"v" => {
            return Err(format!("label {} tells a cache to copy back or to forget: not simulated", quoted(label)));
        }
        _ => return Err(format!("label {} is none of r, w, i, m", quoted(label))),
    };
    Ok(Some(Reference { kind, address: hexadecimal(address)?, len: Some(size(hexadecimal(len)?)?) }))
}

impl TraceImport for Xdin {
    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"r 1003 14\nw ff 0\ni 0 4\nm 10 10\n",
            entries: &[
                Reference { kind: EntryKind::READ, address: 0x1003, len: Some(20) },
                Reference { kind: EntryKind::WRITE, address: 255, len: Some(0) },
                Reference { kind: EntryKind::Instruction, address: 0, len: Some(4) },
                Reference { kind: EntryKind::READ, address: 16, len: Some(16) },
            ],
        }
    }
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    let label = if piece.is_write() { 'w' } else { 'r' };
    Ok(writeln!(output, "{label} {:x} {:x}", piece.address, piece.len)?)
}

impl TraceExport for Xdin {
    fn is_text(&self) -> bool {
        true
    }

    fn carried(&self) -> Carried {
        Carried { sizes: true, kinds: Kinds::ReadsAndWrites }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(write))
    }
}
