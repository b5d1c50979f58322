//! The binary format `oracleGeneral` of libCacheSim, 24 bytes a request: time u32, object u64, size u32, and i64 the index
//! of the next request for the same object, counted from 0 over the whole trace, or -1 if there is none.
//!
//! Read, an object is the byte address of its number. Written, the next requests are found by reading the requests once
//! more from the end, chunk by chunk, in a temporary file; memory grows with the distinct objects only.

use crate::traces::{
    AssumedSize, Carried, EntryKind, EntryParser, EntryShape, Example, Kinds, Parsed, Piece, PieceWriter, Reference,
    TraceExport, TraceImport, Unwritten,
};
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::os::unix::fs::FileExt as _;

pm_registry::registered! {
    /// libCacheSim, 24 bytes a request: time, object (the address), size, index of the next request
    pub struct OracleGeneral = "oracleGeneral" | "oracle-general";
}

/// Bytes of a request.
const BYTES: usize = 24;
/// No request for the object follows.
const NEVER: i64 = -1;
/// Requests read at once.
const CHUNK: u64 = 1 << 16;

fn object(request: &[u8]) -> u64 {
    u64::from_le_bytes(request[4..12].try_into().expect("eight bytes"))
}

fn parse(request: &[u8]) -> Parsed {
    let len = u32::from_le_bytes(request[12..16].try_into().expect("four bytes"));
    Ok(Some(Reference { kind: EntryKind::READ, address: object(request), len: Some(len) }))
}

impl TraceImport for OracleGeneral {
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
            input: b"\x07\0\0\0\x34\x12\0\0\0\0\0\0\x14\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff\
                \x08\0\0\0\x40\0\0\0\0\0\0\0\x40\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff",
            entries: &[
                Reference { kind: EntryKind::READ, address: 0x1234, len: Some(20) },
                Reference { kind: EntryKind::READ, address: 64, len: Some(64) },
            ],
        }
    }
}

/// Requests that do not yet know the next.
struct Writer {
    file: BufWriter<File>,
    number: u64,
}

impl PieceWriter for Writer {
    fn write(&mut self, piece: &Piece, _: &mut dyn Write) -> Result<(), Unwritten> {
        let mut request = [0; BYTES];
        // The time is the number of the search, whatever its unit.
        request[..4].copy_from_slice(&(piece.search as u32).to_le_bytes());
        request[4..12].copy_from_slice(&piece.address.to_le_bytes());
        request[12..16].copy_from_slice(&piece.len.to_le_bytes());
        request[16..].copy_from_slice(&NEVER.to_le_bytes());
        self.number += 1;
        self.file.write_all(&request).map_err(Unwritten::TemporaryFile)
    }

    /// Writes all requests with their next ones.
    fn finish(&mut self, output: &mut dyn Write) -> io::Result<()> {
        self.file.flush()?;
        let file = self.file.get_ref();
        let mut next: HashMap<u64, i64> = HashMap::new();
        let mut buffer = vec![0; CHUNK as usize * BYTES];
        for chunk in (0..self.number.div_ceil(CHUNK)).rev() {
            let (first, place) = (chunk * CHUNK, chunk * CHUNK * BYTES as u64);
            let buffer = &mut buffer[..((self.number - first).min(CHUNK)) as usize * BYTES];
            file.read_exact_at(buffer, place)?;
            for (i, request) in buffer.chunks_exact_mut(BYTES).enumerate().rev() {
                let index = first.cast_signed() + i as i64;
                let after = next.insert(object(request), index).unwrap_or(NEVER);
                request[16..].copy_from_slice(&after.to_le_bytes());
            }
            file.write_all_at(buffer, place)?;
        }
        for chunk in 0..self.number.div_ceil(CHUNK) {
            let first = chunk * CHUNK;
            let buffer = &mut buffer[..((self.number - first).min(CHUNK)) as usize * BYTES];
            file.read_exact_at(buffer, first * BYTES as u64)?;
            output.write_all(buffer)?;
        }
        Ok(())
    }
}

impl TraceExport for OracleGeneral {
    fn is_text(&self) -> bool {
        false
    }

    fn carried(&self) -> Carried {
        Carried { sizes: false, kinds: Kinds::None }
    }

    fn writer(&self) -> io::Result<Box<dyn PieceWriter>> {
        Ok(Box::new(Writer { file: BufWriter::with_capacity(1 << 16, tempfile::tempfile()?), number: 0 }))
    }
}
