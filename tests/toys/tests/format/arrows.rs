//! A toy format that is read and written: `<1000 4` for a read and `>1000 4` for a write, address hexadecimal, size decimal.

use pm_exchange::traces::text::{hexadecimal, number, quoted, size, words};
use pm_exchange::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, Example, Kinds, Parsed, Piece, PieceWriter, Reference, TraceExport,
    TraceImport, Unwritten,
};
use std::io::{self, Write};

pm_registry::registered! {
    /// An arrow from memory or to it, address and size
    pub struct Arrows = "arrows" | "darts";
}

fn parse(line: &[u8]) -> Parsed {
    let wrong = || format!("{} is no arrow", quoted(line));
    let (&arrow, rest) = line.split_first().ok_or_else(wrong)?;
    let kind = match arrow {
        b'<' => EntryKind::READ,
        b'>' => EntryKind::WRITE,
        _ => return Err(wrong()),
    };
    let [address, len] = words(rest).collect::<Vec<_>>()[..] else { return Err(wrong()) };
    Ok(Some(Reference { kind, address: hexadecimal(address)?, len: Some(size(number(len)?)?) }))
}

impl TraceImport for Arrows {
    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"<1000 4\n>ff 16\n",
            entries: &[
                Reference { kind: EntryKind::READ, address: 0x1000, len: Some(4) },
                Reference { kind: EntryKind::WRITE, address: 255, len: Some(16) },
            ],
        }
    }
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    let arrow = if piece.is_write() { '>' } else { '<' };
    Ok(writeln!(output, "{arrow}{:x} {}", piece.address, piece.len)?)
}

impl TraceExport for Arrows {
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
