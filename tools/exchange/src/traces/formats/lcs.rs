//! `lcs`, the binary format of libCacheSim with a header (`traceReader/customizedReader/lcs.h`): 8,192 bytes with a magic
//! number at both ends and the version behind the first, and then requests.
//!
//! Version 1 has the requests of `oracleGeneral`: time u32, object u64, size u32, next request i64. Version 2 has the
//! operation u8 and the tenant u24 before the last of them, version 3 a size of 64 bits and the time to live u32 there too;
//! versions 4 to 8 append 1, 2, 4, 8 or 16 features u32. An object is the byte address of its number. Operations that change
//! an object are writes, and one that deletes it accesses nothing. The statistics behind the version tell how many requests
//! there are, as their second number.

use crate::traces::import::plain;
use crate::traces::text::size;
use crate::traces::{AssumedSize, EntryKind, EntryParser, EntryShape, Example, Parsed, Reference, Sizes, TraceImport};
use pm_formats::trace::Access;

pm_registry::registered! {
    /// libCacheSim, with a header: time, object (the address), size, operation, index of the next request
    pub struct Lcs = "lcs";
}

/// Bytes of the header.
const HEADER: usize = 8192;
/// `LCS_TRACE_START_MAGIC` and `LCS_TRACE_END_MAGIC`.
const MAGIC: [u8; 8] = 0x1234_5678_9abc_def0_u64.to_le_bytes();
/// Bytes of a request by its version, from 1 on.
const BYTES: [usize; 8] = [24, 28, 36, 40, 44, 52, 68, 100];

fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes"))
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
}

/// What an operation (`req_op_e`) does; `None` if it accesses nothing.
fn kind(operation: u8) -> Option<EntryKind> {
    match operation {
        // Set, add, compare and swap, replace, append, prepend; write, update.
        3..=8 | 13 | 14 => Some(EntryKind::WRITE),
        // Increment, decrement.
        10 | 11 => Some(EntryKind::MODIFY),
        // Delete.
        9 => None,
        // Get, gets, read, or nothing that is known.
        _ => Some(EntryKind::READ),
    }
}

/// Knows the version.
#[derive(Default)]
struct Parser {
    version: u64,
    /// Requests that the header promises; 0 if it does not.
    promised: u64,
    requests: u64,
}

impl EntryParser for Parser {
    fn header(&mut self, header: &[u8]) -> Result<usize, String> {
        if header[..8] != MAGIC {
            return Err("it does not begin with the magic number of lcs".into());
        }
        if header[8] == b'<' {
            return Err("it describes requests by a format string, as libCacheSim did before lcs had versions".into());
        }
        self.version = u64_at(header, 8);
        let Some(&bytes) = self.version.checked_sub(1).and_then(|at| BYTES.get(usize::try_from(at).ok()?)) else {
            return Err(format!("version {} is none of 1 to {}", self.version, BYTES.len()));
        };
        if header[HEADER - 8..] != MAGIC {
            return Err("it does not end with the magic number of lcs".into());
        }
        self.promised = u64_at(header, 24);
        Ok(bytes)
    }

    fn parse(&mut self, request: &[u8]) -> Parsed {
        self.requests += 1;
        self.request(request)
    }

    fn plain_records(&mut self, records: &[u8], bytes: usize, sizes: Sizes, accesses: &mut Vec<Access>) -> bool {
        let plain = plain(records.chunks_exact(bytes), sizes, accesses, |request| self.request(request));
        self.requests += if plain { accesses.len() as u64 } else { 0 };
        plain
    }

    fn end(&mut self) -> Result<(), String> {
        let Self { promised, requests, .. } = *self;
        if promised > 0 && promised != requests {
            return Err(format!("{requests} requests, and the header promises {promised}"));
        }
        Ok(())
    }
}

impl Parser {
    /// The request in these bytes.
    fn request(&self, request: &[u8]) -> Parsed {
        let (len, operation) = match self.version {
            1 => (u32_at(request, 12).into(), None),
            2 => (u32_at(request, 12).into(), Some(request[16])),
            _ => (u64_at(request, 12), Some(request[20])),
        };
        let Some(kind) = operation.map_or(Some(EntryKind::READ), kind) else { return Ok(None) };
        Ok(Some(Reference { kind, address: u64_at(request, 4), len: Some(size(len)?) }))
    }
}

impl TraceImport for Lcs {
    fn shape(&self) -> EntryShape {
        EntryShape::Headed { header: HEADER }
    }

    fn assumed_size(&self) -> Option<AssumedSize> {
        None
    }

    fn signs(&self, beginning: &[u8]) -> bool {
        beginning.starts_with(&MAGIC)
    }

    fn parser(&self) -> Box<dyn EntryParser> {
        Box::new(Parser::default())
    }

    fn example(&self) -> Example {
        Example {
            input: &EXAMPLE,
            entries: &[
                Reference { kind: EntryKind::READ, address: 0x1234, len: Some(20) },
                Reference { kind: EntryKind::WRITE, address: 64, len: Some(64) },
            ],
        }
    }
}

/// Two requests of version 2: get and set.
static EXAMPLE: [u8; HEADER + 2 * BYTES[1]] = {
    const REQUESTS: [u8; 2 * BYTES[1]] = *b"\x07\0\0\0\x34\x12\0\0\0\0\0\0\x14\0\0\0\x01\x05\0\0\
        \xff\xff\xff\xff\xff\xff\xff\xff\
        \x08\0\0\0\x40\0\0\0\0\0\0\0\x40\0\0\0\x03\x05\0\0\xff\xff\xff\xff\xff\xff\xff\xff";
    let mut example = [0; HEADER + 2 * BYTES[1]];
    let mut at = 0;
    while at < 8 {
        (example[at], example[HEADER - 8 + at]) = (MAGIC[at], MAGIC[at]);
        at += 1;
    }
    example[8] = 2;
    at = 0;
    while at < REQUESTS.len() {
        example[HEADER + at] = REQUESTS[at];
        at += 1;
    }
    example
};

#[cfg(test)]
mod tests {
    use super::*;

    /// A request of each version: object 0x1234, 20 bytes, and a set from version 2 on.
    fn request(version: usize) -> Vec<u8> {
        let mut request = vec![7, 0, 0, 0, 0x34, 0x12, 0, 0, 0, 0, 0, 0, 20, 0, 0, 0];
        match version {
            1 => {}
            2 => request.extend([3, 9, 9, 9]),
            _ => request.extend([0, 0, 0, 0, 3, 9, 9, 9, 60, 0, 0, 0]),
        }
        request.extend([255; 8]);
        request.resize(BYTES[version - 1], 77);
        request
    }

    #[test]
    fn every_version_is_read() {
        for version in 1..=8 {
            let mut parser = Parser::default();
            let mut header = EXAMPLE[..HEADER].to_vec();
            header[8] = version as u8;
            assert_eq!(parser.header(&header), Ok(BYTES[version - 1]));
            let kind = if version == 1 { EntryKind::READ } else { EntryKind::WRITE };
            let expected = Reference { kind, address: 0x1234, len: Some(20) };
            assert_eq!(parser.parse(&request(version)), Ok(Some(expected)), "version {version}");
        }
    }

    #[test]
    fn a_header_is_judged() {
        let mut parser = Parser::default();
        for (place, byte, said) in [(0, 0, "begin"), (8, 0, "version 0"), (8, 9, "version 9"), (HEADER - 1, 0, "end")] {
            let mut header = EXAMPLE[..HEADER].to_vec();
            header[place] = byte;
            assert!(parser.header(&header).unwrap_err().contains(said), "{place}");
        }
        let mut header = EXAMPLE[..HEADER].to_vec();
        header[8..13].copy_from_slice(b"<IQIQ");
        assert!(parser.header(&header).unwrap_err().contains("format string"));
    }

    #[test]
    fn a_file_that_is_cut_between_requests_is_seen() {
        let mut header = EXAMPLE[..HEADER].to_vec();
        header[24] = 2;
        let mut parser = Parser::default();
        parser.header(&header).unwrap();
        for (requests, whole) in [(0, false), (1, false), (2, true), (3, false)] {
            assert_eq!(parser.end().is_ok(), whole, "{requests} requests");
            parser.parse(&request(2)).unwrap();
        }
    }

    #[test]
    fn what_is_deleted_is_no_access() {
        let mut parser = Parser { version: 2, ..Parser::default() };
        let mut deleted = request(2);
        deleted[16] = 9;
        assert_eq!(parser.parse(&deleted), Ok(None));
    }
}
