//! What `valgrind --tool=lackey --trace-mem=yes` prints: ` L 1ffeffe7e,8`, S for stores, M for a load and a store of the
//! same place by one instruction, `I  04016b80,3` for instructions; address hexadecimal, size decimal.
//!
//! M is one access that reads and writes: one line access, a miss at most once, and the line turns dirty. Valgrind's own
//! lines (`==pid==`, `--pid--`, `**pid**`) and empty ones are passed over.

use crate::traces::text::{hexadecimal, number, quoted, size};
use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, Example, Kinds, Parsed, Piece, PieceWriter, Reference, TraceExport,
    TraceImport, Unwritten,
};
use pm_formats::trace::AccessKind;
use std::io::{self, Write};

pm_registry::registered! {
    /// valgrind --tool=lackey --trace-mem=yes, such as L 1000,20; M is one access that reads and writes
    pub struct Lackey = "lackey";
}

fn parse(line: &[u8]) -> Parsed {
    let text = line.trim_ascii();
    if text.is_empty() || [b"==", b"--", b"**"].iter().any(|banner| text.starts_with(*banner)) {
        return Ok(None);
    }
    let wrong = || format!("{} is no line of lackey, such as ` L 1ffeffe7e,8`", quoted(line));
    let (&letter, rest) = text.split_first().ok_or_else(wrong)?;
    let kind = match letter {
        b'I' => EntryKind::Instruction,
        b'L' => EntryKind::READ,
        b'S' => EntryKind::WRITE,
        b'M' => EntryKind::MODIFY,
        _ => return Err(wrong()),
    };
    let comma = rest.iter().position(|&byte| byte == b',').ok_or_else(wrong)?;
    if !rest.starts_with(b" ") || rest[comma + 1..].starts_with(b"0x") {
        return Err(wrong());
    }
    let address = hexadecimal(rest[..comma].trim_ascii())?;
    Ok(Some(Reference { kind, address, len: Some(size(number(&rest[comma + 1..])?)?) }))
}

impl TraceImport for Lackey {
    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"==12== Lackey, an example\n==12== \n\n S be80199c,4\nI  0023c790,2\n L 0025747c,1\r\n M ffffffffffffffff,1\n",
            entries: &[
                Reference { kind: EntryKind::WRITE, address: 0xbe80_199c, len: Some(4) },
                Reference { kind: EntryKind::Instruction, address: 0x23_c790, len: Some(2) },
                Reference { kind: EntryKind::READ, address: 0x25_747c, len: Some(1) },
                Reference { kind: EntryKind::MODIFY, address: u64::MAX, len: Some(1) },
            ],
        }
    }
}

fn write(piece: &Piece, output: &mut dyn Write) -> Result<(), Unwritten> {
    let letter = match piece.kind {
        AccessKind::Read => 'L',
        AccessKind::Write => 'S',
        AccessKind::ReadModifyWrite => 'M',
    };
    Ok(writeln!(output, " {letter} {:08x},{}", piece.address, piece.len)?)
}

impl TraceExport for Lackey {
    fn is_text(&self) -> bool {
        true
    }

    fn carried(&self) -> Carried {
        Carried { sizes: true, kinds: Kinds::All }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(write))
    }
}
