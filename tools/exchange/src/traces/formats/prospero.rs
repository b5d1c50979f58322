//! `prospero`: requests for the element of that name of SST (`prostextreader.cc`): cycle, R or W, address and bytes, all
//! decimal, such as `12 R 140732920755216 8`.

use crate::traces::text::{number, quoted, size, words};
use crate::traces::{AssumedSize, EntryKind, EntryParser, Example, Parsed, Reference, TraceImport};

pm_registry::registered! {
    /// SST's prospero, text: cycle, R or W, address and bytes, decimal, such as 12 R 4096 8
    pub struct Prospero = "prospero";
}

/// The kind by its letter, which the binary form has too.
pub(super) fn kind(letter: u8) -> Option<EntryKind> {
    match letter {
        b'R' | b'r' => Some(EntryKind::READ),
        b'W' | b'w' => Some(EntryKind::WRITE),
        _ => None,
    }
}

fn parse(line: &[u8]) -> Parsed {
    let wrong = || format!("{} is not a cycle, R or W, an address and bytes", quoted(line));
    let [cycle, &[letter], address, bytes] = words(line).collect::<Vec<_>>()[..] else { return Err(wrong()) };
    let kind = kind(letter).ok_or_else(wrong)?;
    number(cycle)?;
    Ok(Some(Reference { kind, address: number(address)?, len: Some(size(number(bytes)?)?) }))
}

impl TraceImport for Prospero {
    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"12 R 4096 8\n15 W 64 4\n",
            entries: &[
                Reference { kind: EntryKind::READ, address: 4096, len: Some(8) },
                Reference { kind: EntryKind::WRITE, address: 64, len: Some(4) },
            ],
        }
    }
}
