//! `drmemtrace`: what DynamoRIO's tracer of that name leaves for a thread (`clients/drcachesim/common/trace_entry.h`), 12
//! bytes an entry: type u16, size u16, address u64; a header first and a footer last. In a zip archive its parts are one
//! after another.
//!
//! Loads, stores and instruction fetches are accesses; prefetches, flushes, markers, encodings and instructions that are not
//! fetched again are passed over. A bundle holds the lengths of up to eight instructions that follow the one before.

use crate::traces::{AssumedSize, EntryKind, EntryParser, EntryShape, Example, Parsed, Reference, TraceImport};
use std::collections::VecDeque;

pm_registry::registered! {
    /// DynamoRIO's drmemtrace, one thread, plain or in its zip: type, size, address
    pub struct DrMemTrace = "drmemtrace";
}

/// Types of entries (`trace_type_t`).
const READ: u16 = 0;
const WRITE: u16 = 1;
/// Instructions of all kinds that are fetched.
const FETCHED: [std::ops::RangeInclusive<u16>; 3] = [10..=16, 31..=31, 48..=49];
const BUNDLE: u16 = 17;
const THREAD: u16 = 22;
const PID: u16 = 24;
const HEADER: u16 = 25;
const FOOTER: u16 = 26;
const MARKER: u16 = 28;
/// An instruction that is fetched unless it is the one before again.
const MAYBE_FETCHED: u16 = 30;
/// The last type of version 5; later versions may have more.
const LAST: u16 = 63;
/// Instructions of a bundle.
const MOST: u16 = 8;

/// Bytes of an entry.
const BYTES: usize = 12;

fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([bytes[at], bytes[at + 1]])
}

#[derive(Default)]
struct Parser {
    /// Instructions of a bundle that follow.
    rest: VecDeque<Reference>,
    /// Where the instruction before begins, and where the next one does.
    before: u64,
    next: u64,
    begun: bool,
    ended: bool,
}

impl Parser {
    fn instruction(&mut self, address: u64, len: u16) -> Reference {
        (self.before, self.next) = (address, address.wrapping_add(len.into()));
        Reference { kind: EntryKind::Instruction, address, len: Some(len.into()) }
    }
}

impl EntryParser for Parser {
    fn parse(&mut self, entry: &[u8]) -> Parsed {
        let (kind, size) = (u16_at(entry, 0), u16_at(entry, 2));
        let address = u64::from_le_bytes(entry[4..].try_into().expect("eight bytes"));
        if !self.begun && kind != HEADER {
            return Err(format!("an entry of type {kind} where a header (type {HEADER}) begins a trace"));
        }
        (self.begun, self.ended) = (true, kind == FOOTER);
        self.rest.clear();
        Ok(match kind {
            READ => Some(Reference { kind: EntryKind::READ, address, len: Some(size.into()) }),
            WRITE => Some(Reference { kind: EntryKind::WRITE, address, len: Some(size.into()) }),
            MAYBE_FETCHED if address == self.before => None,
            MAYBE_FETCHED => Some(self.instruction(address, size)),
            BUNDLE if size > MOST => return Err(format!("a bundle of {size} instructions; {MOST} are the most")),
            BUNDLE => {
                for &len in &entry[4..4 + usize::from(size)] {
                    let next = self.next;
                    let instruction = self.instruction(next, len.into());
                    self.rest.push_back(instruction);
                }
                self.rest.pop_front()
            }
            _ if FETCHED.iter().any(|range| range.contains(&kind)) => Some(self.instruction(address, size)),
            _ if kind <= LAST => None,
            _ => return Err(format!("type {kind} is none of drmemtrace")),
        })
    }

    fn rest(&mut self) -> Option<Reference> {
        self.rest.pop_front()
    }

    fn end(&mut self) -> Result<(), String> {
        if self.begun && !self.ended {
            return Err("no footer: the trace is cut".into());
        }
        Ok(())
    }
}

impl TraceImport for DrMemTrace {
    fn shape(&self) -> EntryShape {
        EntryShape::Record { bytes: BYTES }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn recognition(&self) -> crate::traces::Recognition {
        crate::traces::Recognition::Signature
    }

    /// A header with a small version, and then an entry that tells of the thread.
    fn signs(&self, beginning: &[u8]) -> bool {
        beginning.len() >= 2 * BYTES
            && (u16_at(beginning, 0), u16_at(beginning, 2)) == (HEADER, 0)
            && beginning[4] > 0
            && beginning[5..BYTES].iter().all(|byte| *byte == 0)
            && [THREAD, PID, MARKER].contains(&u16_at(beginning, BYTES))
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::<Parser>::default()
    }

    fn example(&self) -> Example {
        const fn instruction(address: u64, len: u32) -> Reference {
            Reference { kind: EntryKind::Instruction, address, len: Some(len) }
        }
        Example {
            // Header of version 3, thread, marker, instruction, load, bundle of two, store, one not fetched, footer.
            input: b"\x19\0\0\0\x03\0\0\0\0\0\0\0\x16\0\0\0\x07\0\0\0\0\0\0\0\x1c\0\x02\0\x09\0\0\0\0\0\0\0\
                \x0a\0\x04\0\0\x10\0\0\0\0\0\0\0\0\x08\0\0\x20\0\0\0\0\0\0\x11\0\x02\0\x03\x05\0\0\0\0\0\0\
                \x01\0\x10\0\x40\x20\0\0\0\0\0\0\x1d\0\x05\0\x07\x10\0\0\0\0\0\0\x1a\0\0\0\0\0\0\0\0\0\0\0",
            entries: const {
                &[
                    instruction(0x1000, 4),
                    Reference { kind: EntryKind::READ, address: 0x2000, len: Some(8) },
                    instruction(0x1004, 3),
                    instruction(0x1007, 5),
                    Reference { kind: EntryKind::WRITE, address: 0x2040, len: Some(16) },
                ]
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(kind: u16, size: u16, address: u64) -> Vec<u8> {
        [&kind.to_le_bytes()[..], &size.to_le_bytes(), &address.to_le_bytes()].concat()
    }

    #[test]
    fn a_trace_has_a_header_and_a_footer() {
        let mut parser = Parser::default();
        assert!(parser.parse(&entry(READ, 8, 64)).unwrap_err().contains("header"));
        parser.parse(&entry(HEADER, 0, 5)).unwrap();
        parser.parse(&entry(READ, 8, 64)).unwrap();
        assert!(parser.end().unwrap_err().contains("cut"));
        parser.parse(&entry(FOOTER, 0, 0)).unwrap();
        assert_eq!(parser.end(), Ok(()));
    }

    #[test]
    fn instructions_are_those_that_are_fetched() {
        let mut parser = Parser { begun: true, ..Parser::default() };
        // Plain, branches, sysenter, taken and not taken; the first and the last of each range.
        for kind in 0..=LAST {
            let fetched = matches!(kind, 10..=16 | 31 | 48 | 49);
            if ![READ, WRITE, BUNDLE, MAYBE_FETCHED].contains(&kind) {
                assert_eq!(parser.parse(&entry(kind, 4, 4096)).unwrap().is_some(), fetched, "type {kind}");
            }
        }
        // The same instruction again is fetched once.
        let maybe = |address| entry(MAYBE_FETCHED, 4, address);
        assert_eq!(parser.parse(&maybe(8192)).unwrap().map(|fetch| fetch.address), Some(8192));
        assert_eq!(parser.parse(&maybe(8192)), Ok(None));
        assert!(parser.parse(&entry(BUNDLE, 9, 0)).is_err() && parser.parse(&entry(64, 0, 0)).is_err());
    }
}
