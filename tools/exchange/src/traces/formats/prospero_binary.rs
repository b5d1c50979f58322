//! `prospero-binary`: the same as [`prospero`](super::prospero) in 21 bytes (`prosbinaryreader.cc`): cycle u64, the letter R
//! or W, address u64, bytes u32, without gaps.

use super::prospero::kind;
use crate::traces::{AssumedSize, EntryKind, EntryParser, EntryShape, Example, Parsed, Reference, TraceImport};

pm_registry::registered! {
    /// SST's prospero, binary, 21 bytes a request: cycle, R or W, address, bytes
    pub struct ProsperoBinary = "prospero-binary";
}

/// Bytes of a request.
const BYTES: usize = 21;

fn parse(request: &[u8]) -> Parsed {
    let kind = kind(request[8]).ok_or_else(|| format!("kind {} is none of R and W", request[8]))?;
    let address = u64::from_le_bytes(request[9..17].try_into().expect("eight bytes"));
    let len = u32::from_le_bytes(request[17..].try_into().expect("four bytes"));
    Ok(Some(Reference { kind, address, len: Some(len) }))
}

impl TraceImport for ProsperoBinary {
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
            input: b"\x0c\0\0\0\0\0\0\0R\0\x10\0\0\0\0\0\0\x08\0\0\0\x0f\0\0\0\0\0\0\0W\x40\0\0\0\0\0\0\0\x04\0\0\0",
            entries: &[
                Reference { kind: EntryKind::READ, address: 4096, len: Some(8) },
                Reference { kind: EntryKind::WRITE, address: 64, len: Some(4) },
            ],
        }
    }
}
