//! `ramulator-cpu`: what a core does, for Ramulator 1 (`--mode=cpu`) and 2 (`SimpleO3`): the number of instructions before a
//! load, its address, and the address of a line that is written back, if one is; numbers are decimal.
//!
//! Such lines may be those of `din` as well, which are then told apart by name.

use crate::traces::text::{number, quoted, words};
use crate::traces::{AssumedSize, EntryKind, EntryParser, Example, Parsed, Reference, TraceImport};

pm_registry::registered! {
    /// Ramulator 1 and 2, of a core: instructions between, address read, address written back if any, such as 3 20734016
    pub struct RamulatorCpu = "ramulator-cpu";
}

const fn access(kind: EntryKind, address: u64) -> Reference {
    Reference { kind, address, len: None }
}

/// Holds the line that is written back.
#[derive(Default)]
struct Parser {
    written: Option<u64>,
}

impl EntryParser for Parser {
    fn parse(&mut self, line: &[u8]) -> Parsed {
        self.written = None;
        let words: Vec<&[u8]> = words(line).collect();
        let (read, written) = match words[..] {
            [between, read] => (number(between).and(number(read))?, None),
            [between, read, written] => (number(between).and(number(read))?, Some(number(written)?)),
            _ => return Err(format!("{} is not instructions, an address and perhaps another", quoted(line))),
        };
        self.written = written;
        Ok(Some(access(EntryKind::READ, read)))
    }

    fn rest(&mut self) -> Option<Reference> {
        self.written.take().map(|address| access(EntryKind::WRITE, address))
    }
}

impl TraceImport for RamulatorCpu {
    fn assumed_size(&self) -> Option<AssumedSize> {
        // What a memory transfers at once.
        Some(AssumedSize::bytes(64))
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::<Parser>::default()
    }

    fn example(&self) -> Example {
        Example {
            input: b"3 20734016\n1 20846400\n16 20734208 20841280\n8 20841280 20841344\n",
            entries: const {
                &[
                    access(EntryKind::READ, 20_734_016),
                    access(EntryKind::READ, 20_846_400),
                    access(EntryKind::READ, 20_734_208),
                    access(EntryKind::WRITE, 20_841_280),
                    access(EntryKind::READ, 20_841_280),
                    access(EntryKind::WRITE, 20_841_344),
                ]
            },
        }
    }
}
