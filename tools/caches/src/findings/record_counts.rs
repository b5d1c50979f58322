//! What a trace asks for, before any cache.

use pm_formats::trace::AccessKind;

/// Record accesses of a region as the trace has them, before any cache. All counts leave warm-up out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RecordCounts {
    /// Records read.
    pub reads: u64,
    /// Records written without being read.
    pub writes: u64,
    /// Records read, changed and written back.
    pub read_modify_writes: u64,
    /// Bytes of records read, those of read-modify-writes included.
    pub bytes_read: u64,
    /// Bytes of records written, those of read-modify-writes included.
    pub bytes_written: u64,
}

impl RecordCounts {
    /// Adds `number` records of one kind with `bytes` bytes together.
    pub(crate) fn add_records(&mut self, kind: AccessKind, number: u64, bytes: u64) {
        match kind {
            AccessKind::Read => self.reads += number,
            AccessKind::Write => self.writes += number,
            AccessKind::ReadModifyWrite => self.read_modify_writes += number,
        }
        if kind != AccessKind::Write {
            self.bytes_read += bytes;
        }
        if kind != AccessKind::Read {
            self.bytes_written += bytes;
        }
    }

    /// Adds another region's counts.
    pub(crate) fn add(&mut self, other: &Self) {
        self.reads += other.reads;
        self.writes += other.writes;
        self.read_modify_writes += other.read_modify_writes;
        self.bytes_read += other.bytes_read;
        self.bytes_written += other.bytes_written;
    }
}
