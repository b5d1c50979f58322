//! A chip that counts what is reserved of it, and memory: files, written and read in bursts.

use crate::{BURST_BUFFER, Store, StoredQuery};
use bytemuck::Zeroable as _;
use pm_formats::{Bounds, Query};
use std::collections::{HashMap, VecDeque};
use std::fs::File;
use std::io::{Read as _, Seek as _, SeekFrom, Write as _};

/// The scene that all queries of a trial lie in.
pub(super) const UNIT: Bounds = Bounds { min: [0.0; 3], max: [1.0; 3] };

/// Bytes that go to memory or come from there at a time: half a buffer.
const BURST: usize = BURST_BUFFER as usize / 2;

/// Bytes on chip, now and at most.
#[derive(Default)]
pub(super) struct Chip {
    now: u64,
    pub(super) most: u64,
}

impl Chip {
    pub(super) fn reserve(&mut self, bytes: u64) {
        self.now += bytes;
        self.most = self.most.max(self.now);
    }

    pub(super) fn release(&mut self, bytes: u64) {
        self.now = self.now.checked_sub(bytes).expect("only what is reserved is released");
    }
}

/// The machine: its store, its chip, what it moved to memory and back, and the queries that left.
pub(super) struct Machine {
    pub(super) store: Store,
    pub(super) chip: Chip,
    pub(super) written: u64,
    pub(super) read: u64,
    pub(super) left: Vec<Query>,
    /// Rays by pixel and sample, to be cast again.
    rays: HashMap<(u32, u32), Query>,
}

/// A file of memory that is being written: records one after another, and a buffer on chip.
pub(super) struct Writer {
    file: File,
    buffer: Vec<u8>,
}

/// The same being read.
pub(super) struct Reader {
    file: File,
    buffer: VecDeque<u8>,
}

impl Machine {
    pub(super) fn new(store: Store, rays: &[Query]) -> Self {
        let rays = rays.iter().map(|&query| ((query.pixel, query.sample), query)).collect();
        Self { store, chip: Chip::default(), written: 0, read: 0, left: vec![], rays }
    }

    /// Bytes of so many records.
    pub(super) const fn bytes(&self, records: u64) -> u64 {
        records * self.store.record.bytes()
    }

    /// A record as it is stored: the query, or 21 bits of its pixel, 21 of its sample and 30 of its key.
    pub(super) fn stored(&self, query: &Query, key: u32) -> Vec<u8> {
        match self.store.record {
            StoredQuery::Full => bytemuck::bytes_of(query).to_vec(),
            StoredQuery::Compact => {
                assert!(query.pixel < 1 << 21 && query.sample < 1 << 21, "small pictures only");
                let bits = u128::from(query.pixel) << 51 | u128::from(query.sample) << 30 | u128::from(key >> 2);
                bits.to_le_bytes()[..9].to_vec()
            }
        }
    }

    /// The query of a record; the ray of a compact one is cast again.
    pub(super) fn query(&self, record: &[u8]) -> Query {
        if self.store.record == StoredQuery::Full {
            let mut query = Query::zeroed();
            bytemuck::bytes_of_mut(&mut query).copy_from_slice(record);
            return query;
        }
        let mut bytes = [0; 16];
        bytes[..9].copy_from_slice(record);
        let bits = u128::from_le_bytes(bytes);
        self.rays[&((bits >> 51) as u32 & 0x1f_ffff, (bits >> 30) as u32 & 0x1f_ffff)]
    }

    /// Begins a file of memory; its buffer is reserved by whoever knows how many there are.
    pub(super) fn writer() -> Writer {
        Writer { file: tempfile::tempfile().unwrap(), buffer: vec![] }
    }

    /// Adds a record to a file.
    pub(super) fn write(&mut self, writer: &mut Writer, query: &Query, key: u32) {
        writer.buffer.extend(self.stored(query, key));
        while writer.buffer.len() >= BURST {
            let burst: Vec<u8> = writer.buffer.drain(..BURST).collect();
            writer.file.write_all(&burst).unwrap();
            self.written += BURST as u64;
        }
        assert!(writer.buffer.len() <= BURST, "half of the buffer is on its way");
    }

    /// Ends writing, and begins to read from the start.
    pub(super) fn turn(&mut self, mut writer: Writer) -> Reader {
        writer.file.write_all(&writer.buffer).unwrap();
        self.written += writer.buffer.len() as u64;
        writer.file.seek(SeekFrom::Start(0)).unwrap();
        Reader { file: writer.file, buffer: VecDeque::new() }
    }

    /// The next query of a file.
    pub(super) fn next(&mut self, reader: &mut Reader) -> Option<Query> {
        let size = self.store.record.bytes() as usize;
        if reader.buffer.len() < size {
            let mut burst = [0; BURST];
            let came = reader.file.read(&mut burst).unwrap();
            self.read += came as u64;
            reader.buffer.extend(&burst[..came]);
        }
        assert!(reader.buffer.len() <= BURST_BUFFER as usize);
        if reader.buffer.is_empty() {
            return None;
        }
        let record: Vec<u8> = reader.buffer.drain(..size).collect();
        Some(self.query(&record))
    }
}
