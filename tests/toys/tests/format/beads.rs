//! A toy format that is only read: big-endian numbers of 16 bits, each that of a word of two bytes.

use pm_exchange::traces::{AssumedSize, EntryKind, EntryParser, EntryShape, Example, Parsed, Reference, TraceImport};

pm_registry::registered! {
    /// Numbers of 16 bits on a string
    pub struct Beads = "beads";
}

fn parse(bead: &[u8]) -> Parsed {
    let address = u16::from_be_bytes([bead[0], bead[1]]).into();
    Ok(Some(Reference { kind: EntryKind::READ, address, len: None }))
}

impl TraceImport for Beads {
    fn shape(&self) -> EntryShape {
        EntryShape::Record { bytes: 2 }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize { bytes: 2, aligned: true })
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(parse)
    }

    fn example(&self) -> Example {
        Example {
            input: &[0x12, 0x35, 0, 8],
            entries: &[
                Reference { kind: EntryKind::READ, address: 0x1235, len: None },
                Reference { kind: EntryKind::READ, address: 8, len: None },
            ],
        }
    }
}
