//! `stl`: transactions for DRAMSys (`StlPlayer.cpp`): cycle, the bytes in parentheses if they are told, `read` or `write`,
//! the address, hexadecimal, and perhaps the data. Lines that begin with `#` are comments. A colon may follow the cycle.

use crate::traces::text::{hexadecimal, number, quoted, size, words};
use crate::traces::{AssumedSize, EntryKind, EntryParser, Example, Parsed, Reference, TraceImport};

pm_registry::registered! {
    /// DRAMSys: cycle, perhaps (bytes), read or write, address, such as 31: (64) read 0x400140
    pub struct Stl = "stl";
}

fn parse(line: &[u8]) -> Parsed {
    if line.trim_ascii().starts_with(b"#") {
        return Ok(None);
    }
    let wrong = || format!("{} is no line of stl, such as `31 read 0x400140`", quoted(line));
    let words: Vec<&[u8]> = words(line).collect();
    let (&cycle, rest) = words.split_first().ok_or_else(wrong)?;
    let told = rest.first().and_then(|word| word.strip_prefix(b"(")?.strip_suffix(b")"));
    let rest = if told.is_some() { &rest[1..] } else { rest };
    let (kind, address) = match *rest {
        [b"read", address] => (EntryKind::READ, address),
        [b"write", address] | [b"write", address, _] => (EntryKind::WRITE, address),
        _ => return Err(wrong()),
    };
    number(cycle.strip_suffix(b":").unwrap_or(cycle))?;
    let len = told.map(|bytes| size(number(bytes)?)).transpose()?;
    Ok(Some(Reference { kind, address: hexadecimal(address)?, len }))
}

impl TraceImport for Stl {
    fn assumed_size(&self) -> Option<AssumedSize> {
        // What a memory transfers at once.
        Some(AssumedSize::bytes(64))
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"# a comment\n31:\tread\t0x400140\n33\t(32)\twrite\t400200\t0x5f3c\n40 (128) read 0x40\n",
            entries: &[
                Reference { kind: EntryKind::READ, address: 0x40_0140, len: None },
                Reference { kind: EntryKind::WRITE, address: 0x40_0200, len: Some(32) },
                Reference { kind: EntryKind::READ, address: 0x40, len: Some(128) },
            ],
        }
    }
}
