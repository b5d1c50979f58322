//! `ramulator1`: requests to a memory for Ramulator 1 (`--mode=dram`), such as `0x12345680 R`; the address is hexadecimal.

use crate::traces::text::{hexadecimal, quoted, words};
use crate::traces::{AssumedSize, EntryKind, EntryParser, Example, Parsed, Reference, TraceImport};

pm_registry::registered! {
    /// Ramulator 1, of a memory: address, and R or W, such as 0x12345680 R
    pub struct Ramulator1 = "ramulator1";
}

fn parse(line: &[u8]) -> Parsed {
    let (address, kind) = match words(line).collect::<Vec<_>>()[..] {
        [address, b"R"] => (address, EntryKind::READ),
        [address, b"W"] => (address, EntryKind::WRITE),
        _ => return Err(format!("{} is not an address and R or W", quoted(line))),
    };
    Ok(Some(Reference { kind, address: hexadecimal(address)?, len: None }))
}

impl TraceImport for Ramulator1 {
    fn assumed_size(&self) -> Option<AssumedSize> {
        // What a memory transfers at once.
        Some(AssumedSize::bytes(64))
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: b"0x12345680 R\n4cbd56c0 W\n",
            entries: &[
                Reference { kind: EntryKind::READ, address: 0x1234_5680, len: None },
                Reference { kind: EntryKind::WRITE, address: 0x4cbd_56c0, len: None },
            ],
        }
    }
}
