//! The binary format `oracleGeneral` of libCacheSim, 24 bytes a request: time u32, object u64, size u32, and i64 the index
//! of the next request for the same object, counted from 0 over the whole trace, or -1 if there is none.
//!
//! Read, an object is the byte address of its number. Written, the next requests are found by reading the requests once
//! more from the end, chunk by chunk, in a temporary file; memory grows with the distinct objects only.

use super::{Parsed, READ, Reference};
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::os::unix::fs::FileExt as _;

pub(super) const BYTES: usize = 24;
/// No request for the object follows.
const NEVER: i64 = -1;
/// Requests read at once.
const CHUNK: u64 = 1 << 16;

fn object(bytes: &[u8]) -> u64 {
    u64::from_le_bytes(bytes[4..12].try_into().expect("eight bytes"))
}

pub(super) fn parse(bytes: &[u8]) -> Parsed {
    let len = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes"));
    Ok(Some(Reference { kind: READ, address: object(bytes), len: Some(len) }))
}

/// Requests that do not yet know the next.
pub(super) struct Requests {
    file: BufWriter<File>,
    number: u64,
}

impl Requests {
    pub(super) fn new() -> io::Result<Self> {
        Ok(Self { file: BufWriter::with_capacity(1 << 16, tempfile::tempfile()?), number: 0 })
    }

    /// Adds a request at a time of any unit.
    pub(super) fn push(&mut self, time: u32, object: u64, len: u32) -> io::Result<()> {
        let mut bytes = [0; BYTES];
        bytes[..4].copy_from_slice(&time.to_le_bytes());
        bytes[4..12].copy_from_slice(&object.to_le_bytes());
        bytes[12..16].copy_from_slice(&len.to_le_bytes());
        bytes[16..].copy_from_slice(&NEVER.to_le_bytes());
        self.number += 1;
        self.file.write_all(&bytes)
    }

    /// Writes all requests with their next ones.
    pub(super) fn finish(self, output: &mut impl Write) -> io::Result<()> {
        let file = self.file.into_inner().map_err(io::IntoInnerError::into_error)?;
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
