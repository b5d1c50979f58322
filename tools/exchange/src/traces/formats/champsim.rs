//! `champsim`: the instructions of ChampSim (`inc/trace_instruction.h`, `input_instr`), 64 bytes each: instruction pointer
//! u64, two bytes for branches, two registers written and four read, and then the addresses u64 of two words written and of
//! four read; 0 is none.
//!
//! An instruction is fetched, reads and then writes. How many bytes is not said, and ChampSim touches one line for each.

use crate::traces::{AssumedSize, EntryKind, EntryParser, EntryShape, Example, Parsed, Reference, TraceImport};

pm_registry::registered! {
    /// ChampSim, 64 bytes an instruction: its address, 2 addresses written, 4 read
    pub struct ChampSim = "champsim";
}

const fn access(kind: EntryKind, address: u64) -> Reference {
    Reference { kind, address, len: None }
}

/// Understands instructions whose addresses written and read stand at these places, so many of each.
pub(super) struct Parser {
    written: (usize, usize),
    read: (usize, usize),
    /// Accesses that follow, the last one first.
    rest: Vec<Reference>,
}

impl Parser {
    pub(super) fn new(written: (usize, usize), read: (usize, usize)) -> Self {
        Self { written, read, rest: vec![] }
    }
}

impl EntryParser for Parser {
    fn parse(&mut self, instruction: &[u8]) -> Parsed {
        let address = |at: usize| u64::from_le_bytes(instruction[at..at + 8].try_into().expect("eight bytes"));
        let addresses =
            |(at, number): (usize, usize)| (0..number).map(move |i| address(at + 8 * i)).filter(|&at| at != 0);
        self.rest.clear();
        self.rest.extend(addresses(self.read).map(|address| access(EntryKind::READ, address)));
        self.rest.extend(addresses(self.written).map(|address| access(EntryKind::WRITE, address)));
        self.rest.reverse();
        Ok(Some(access(EntryKind::Instruction, address(0))))
    }

    fn rest(&mut self) -> Option<Reference> {
        self.rest.pop()
    }
}

impl TraceImport for ChampSim {
    fn shape(&self) -> EntryShape {
        EntryShape::Record { bytes: 64 }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        Some(AssumedSize::BYTE)
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(Parser::new((16, 2), (32, 4)))
    }

    fn example(&self) -> Example {
        // An instruction that reads two words and writes one, and one that does nothing of that.
        const INPUT: [u8; 128] = {
            let mut input = [0; 128];
            (input[1], input[8 + 4], input[17], input[33], input[34], input[41]) = (0x40, 6, 0x30, 0x10, 0x7f, 0x20);
            (input[64], input[65]) = (4, 0x40);
            input
        };
        Example {
            input: &INPUT,
            entries: const {
                &[
                    access(EntryKind::Instruction, 0x4000),
                    access(EntryKind::READ, 0x7f_1000),
                    access(EntryKind::READ, 0x2000),
                    access(EntryKind::WRITE, 0x3000),
                    access(EntryKind::Instruction, 0x4004),
                ]
            },
        }
    }
}
