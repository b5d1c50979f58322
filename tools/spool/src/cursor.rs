//! What was set aside, read again.

use crate::Event;
use crate::token::{FAR, Last, MOST_BYTES, NEAR, SEARCH};
use pm_formats::trace::{Access, AccessKind};
use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt as _;

/// Reads a stretch of a spool.
pub struct Cursor<'a> {
    file: &'a File,
    /// Place in the file of the first byte that is not in the buffer.
    next: u64,
    end: u64,
    buffer: Vec<u8>,
    at: usize,
    last: Last,
}

/// Bytes read at once: small, for many cursors read at a time.
const BUFFER: u64 = 1 << 15;

impl<'a> Cursor<'a> {
    /// What lies from one mark to another.
    pub(crate) const fn new(file: &'a File, from: u64, to: u64) -> Self {
        Self { file, next: from, end: to, buffer: vec![], at: 0, last: Last::START }
    }

    /// The next event, `None` at the end.
    ///
    /// # Errors
    /// What the file reports.
    pub fn next_event(&mut self) -> io::Result<Option<Event>> {
        self.fill()?;
        if self.at == self.buffer.len() {
            return Ok(None);
        }
        let token = self.varint();
        let value = token >> 2;
        Ok(Some(match token & 3 {
            NEAR => {
                let step = (value >> 1) ^ (value & 1).wrapping_neg();
                self.last.0.offset = self.last.0.offset.wrapping_add(step);
                Event::Access(self.last.0)
            }
            FAR => {
                let bytes: [u8; 15] = self.buffer[self.at..self.at + 15].try_into().expect("fifteen bytes");
                self.at += 15;
                let kind = match bytes[2] {
                    0 => AccessKind::Read,
                    1 => AccessKind::Write,
                    _ => AccessKind::ReadModifyWrite,
                };
                self.last = Last(Access {
                    kind,
                    region: u16::from_le_bytes([bytes[0], bytes[1]]),
                    len: u32::from_le_bytes(bytes[3..7].try_into().expect("four bytes")),
                    offset: u64::from_le_bytes(bytes[7..].try_into().expect("eight bytes")),
                });
                Event::Access(self.last.0)
            }
            SEARCH => {
                self.last = Last::START;
                let mut destinations = Vec::new();
                for _ in 0..value >> 1 {
                    self.fill()?;
                    destinations.push(self.varint() as u32);
                }
                Event::Search { warm_up: value & 1 == 1, destinations }
            }
            _ => Event::SearchEnd,
        }))
    }

    /// Has the bytes of the next token in the buffer, if there are any.
    fn fill(&mut self) -> io::Result<()> {
        if self.buffer.len() - self.at >= MOST_BYTES || self.next == self.end {
            return Ok(());
        }
        self.buffer.drain(..self.at);
        self.at = 0;
        let kept = self.buffer.len();
        let more = BUFFER.min(self.end - self.next);
        self.buffer.resize(kept + more as usize, 0);
        self.file.read_exact_at(&mut self.buffer[kept..], self.next)?;
        self.next += more;
        Ok(())
    }

    fn varint(&mut self) -> u64 {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = self.buffer[self.at];
            self.at += 1;
            value |= u64::from(byte & 0x7f) << shift;
            shift += 7;
            if byte < 0x80 {
                return value;
            }
        }
    }
}
