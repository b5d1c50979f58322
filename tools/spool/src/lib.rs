//! Searches and their accesses set aside in a temporary file, to be read again from the start of any search.
//!
//! An access costs two or three bytes while region, kind and length stay as they were, sixteen when they change. The file
//! has no name and lies where temporary files do (`TMPDIR`).

use pm_formats::trace::{Access, AccessKind};
use std::fs::File;
use std::io::{self, BufWriter, Seek as _, SeekFrom, Write as _};
use std::os::unix::fs::FileExt as _;

/// What a spool holds, in the order it was put there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A search begins.
    Search {
        /// It is simulated but not counted.
        warm_up: bool,
        /// Pixels that it serves.
        destinations: Vec<u32>,
    },
    /// Memory is accessed.
    Access(Access),
    /// The search is over.
    SearchEnd,
}

/// The access before, from which the next differs little.
#[derive(Clone, Copy)]
struct Last(Access);

impl Last {
    const START: Self = Self(Access::read(0, 0, 0));
}

/// Low bits of a token, what follows, and what is in its upper bits:
/// an access like the last but for its offset; the zigzag difference.
const NEAR: u64 = 0;
/// An access spelled out in the 15 bytes that follow.
const FAR: u64 = 1;
/// A search; 2 x number of destinations + warm-up. The destinations follow.
const SEARCH: u64 = 2;
/// The end of a search.
const END: u64 = 3;

/// No token or destination takes more bytes: a varint, and an access spelled out.
const MOST_BYTES: usize = 10 + 15;

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
        Cursor { file: self.file.get_ref(), next: from, end: to, buffer: vec![], at: 0, last: Last::START }
    }
}

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

impl Cursor<'_> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn any_access() -> impl Strategy<Value = Access> {
        let kind = prop_oneof![Just(AccessKind::Read), Just(AccessKind::Write), Just(AccessKind::ReadModifyWrite)];
        let offset = prop_oneof![0u64..500, any::<u64>()];
        let len = prop_oneof![Just(20u32), any::<u32>()];
        (kind, 0u16..2, len, offset).prop_map(|(kind, region, len, offset)| Access { kind, region, len, offset })
    }

    proptest! {
        #[test]
        fn searches_come_back_from_any_of_them_on(
            searches in prop::collection::vec(
                (any::<bool>(), prop::collection::vec(any::<u32>(), 0..4), prop::collection::vec(any_access(), 0..3000)),
                1..8,
            ),
            from in any::<prop::sample::Index>(),
        ) {
            let mut spool = Spool::new().unwrap();
            spool.search(false, &[1, 2, 3]).unwrap();
            spool.clear().unwrap();
            let (mut marks, mut events) = (vec![], vec![]);
            for (warm_up, destinations, accesses) in searches {
                marks.push((spool.mark(), events.len()));
                spool.search(warm_up, &destinations).unwrap();
                accesses.iter().for_each(|&access| spool.access(access).unwrap());
                spool.search_end().unwrap();
                events.push(Event::Search { warm_up, destinations });
                events.extend(accesses.into_iter().map(Event::Access));
                events.push(Event::SearchEnd);
            }
            let end = spool.mark();
            spool.flush().unwrap();
            let (place, first) = marks[from.index(marks.len())];
            let mut cursor = spool.cursor(place, end);
            for event in &events[first..] {
                let found = cursor.next_event().unwrap();
                prop_assert_eq!(found.as_ref(), Some(event));
            }
            prop_assert_eq!(cursor.next_event().unwrap(), None);
        }
    }
}
