//! What is set aside, and where.

use crate::Cursor;
use crate::token::{END, FAR, Last, NEAR, SEARCH};
use pm_formats::trace::Access;
use std::fs::File;
use std::io::{self, BufWriter, Seek as _, SeekFrom, Write as _};

/// Accesses in a temporary file.
pub struct Spool {
    file: BufWriter<File>,
    bytes: u64,
    last: Last,
}

impl Spool {
    /// An empty one.
    ///
    /// # Errors
    /// If no temporary file can be made.
    pub fn new() -> io::Result<Self> {
        Ok(Self { file: BufWriter::with_capacity(1 << 16, tempfile::tempfile()?), bytes: 0, last: Last::START })
    }

    /// The place where the next event will be; a [`Cursor`] can begin or end there.
    pub fn mark(&mut self) -> u64 {
        self.last = Last::START;
        self.bytes
    }

    /// Forgets everything.
    ///
    /// # Errors
    /// What the file reports.
    pub fn clear(&mut self) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(0))?;
        self.file.get_ref().set_len(0)?;
        (self.bytes, self.last) = (0, Last::START);
        Ok(())
    }

    /// A search begins that serves these pixels.
    ///
    /// # Errors
    /// What the file reports.
    pub fn search(&mut self, warm_up: bool, destinations: &[u32]) -> io::Result<()> {
        self.token(SEARCH, (destinations.len() as u64) << 1 | u64::from(warm_up))?;
        destinations.iter().try_for_each(|&pixel| self.varint(pixel.into()))
    }

    /// Memory is accessed.
    ///
    /// # Errors
    /// What the file reports.
    pub fn access(&mut self, access: Access) -> io::Result<()> {
        let last = std::mem::replace(&mut self.last, Last(access)).0;
        let step = access.offset.wrapping_sub(last.offset).cast_signed();
        let zigzag = ((step << 1) ^ (step >> 63)).cast_unsigned();
        if (Access { offset: last.offset, ..access }) == last && zigzag >> 62 == 0 {
            return self.token(NEAR, zigzag);
        }
        self.token(FAR, 0)?;
        let mut bytes = [0; 15];
        bytes[..2].copy_from_slice(&access.region.to_le_bytes());
        bytes[2] = access.kind as u8;
        bytes[3..7].copy_from_slice(&access.len.to_le_bytes());
        bytes[7..].copy_from_slice(&access.offset.to_le_bytes());
        self.bytes += 15;
        self.file.write_all(&bytes)
    }

    /// The search is over.
    ///
    /// # Errors
    /// What the file reports.
    pub fn search_end(&mut self) -> io::Result<()> {
        self.token(END, 0)
    }

    fn token(&mut self, code: u64, value: u64) -> io::Result<()> {
        self.varint(value << 2 | code)
    }

    fn varint(&mut self, mut value: u64) -> io::Result<()> {
        let (mut bytes, mut len) = ([0; 10], 0);
        loop {
            bytes[len] = (value as u8 & 0x7f) | (u8::from(value > 0x7f) << 7);
            (value, len) = (value >> 7, len + 1);
            if value == 0 {
                break;
            }
        }
        self.bytes += len as u64;
        self.file.write_all(&bytes[..len])
    }

    /// Everything set aside is in the file; call it before [`cursor`](Self::cursor).
    ///
    /// # Errors
    /// What the file reports.
    pub fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }

    /// Reads what lies between two marks.
    #[must_use]
    pub fn cursor(&self, from: u64, to: u64) -> Cursor<'_> {
        Cursor::new(self.file.get_ref(), from, to)
    }
}
