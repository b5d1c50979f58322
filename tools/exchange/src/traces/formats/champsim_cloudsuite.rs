//! `champsim-cloudsuite`: the instructions of ChampSim's traces of CloudSuite (`cloudsuite_instr`), 96 bytes each, as a
//! compiler lays them out: as those of [`champsim`](super::champsim), but with four registers and four addresses written, and
//! two bytes for the address space at the end.

use super::champsim::Parser;
use crate::traces::{AssumedSize, EntryKind, EntryParser, EntryShape, Example, Reference, TraceImport};

pm_registry::registered! {
    /// ChampSim's traces of CloudSuite, 96 bytes an instruction: its address, 4 addresses written, 4 read
    pub struct ChampSimCloudSuite = "champsim-cloudsuite";
}

impl TraceImport for ChampSimCloudSuite {
    fn shape(&self) -> EntryShape {
        EntryShape::Record { bytes: 96 }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize::BYTE)
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        // Ten bytes of branches and registers behind the pointer, and six that align what follows.
        Box::new(Parser::new((24, 4), (56, 4)))
    }

    fn example(&self) -> Example {
        const INPUT: [u8; 96] = {
            let mut input = [0; 96];
            (input[1], input[25], input[49], input[57], input[81], input[88]) = (0x40, 0x30, 0x50, 0x10, 0x20, 1);
            input
        };
        Example {
            input: &INPUT,
            entries: const {
                &[
                    Reference { kind: EntryKind::Instruction, address: 0x4000, len: None },
                    Reference { kind: EntryKind::READ, address: 0x1000, len: None },
                    Reference { kind: EntryKind::READ, address: 0x2000, len: None },
                    Reference { kind: EntryKind::WRITE, address: 0x3000, len: None },
                    Reference { kind: EntryKind::WRITE, address: 0x5000, len: None },
                ]
            },
        }
    }
}
