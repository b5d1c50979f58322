//! What a trace says: accesses to memory, and who listens.

use super::Waits;

/// What an access does to memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum AccessKind {
    /// The bytes are read.
    Read = 0,
    /// The bytes are written without being read.
    Write = 1,
    /// The bytes are read, changed and written back.
    ReadModifyWrite = 2,
}

/// One access to memory: `len` bytes at byte `offset` of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Access {
    /// What is done.
    pub kind: AccessKind,
    /// Index into the header's regions.
    pub region: u16,
    /// Bytes accessed.
    pub len: u32,
    /// Byte offset from the region's base.
    pub offset: u64,
}

impl Access {
    /// A read of `len` bytes at `offset` of `region`.
    #[inline]
    #[must_use]
    pub const fn read(region: u16, offset: u64, len: u32) -> Self {
        Self { kind: AccessKind::Read, region, len, offset }
    }
}

/// Listens to a trace as it is replayed.
///
/// For each block: [`block`](TraceSink::block), then for each search [`search`](TraceSink::search), its accesses in the
/// order they were made, and [`search_end`](TraceSink::search_end).
pub trait TraceSink {
    /// A block of searches begins; `warm_up` accesses are simulated but not counted.
    fn block(&mut self, batch: u64, warm_up: bool) {
        let _ = (batch, warm_up);
    }
    /// A search begins that serves one query for each of `destinations` (pixel numbers, row by row).
    fn search(&mut self, destinations: &[u32]) {
        let _ = destinations;
    }
    /// Of a trace that says so ([`Coding::Waiting`](super::Coding::Waiting)): what the access that comes next waits for.
    fn waits(&mut self, waits: Waits) {
        let _ = waits;
    }
    /// The search reads or writes memory.
    fn access(&mut self, access: Access);
    /// The same, many times over.
    fn accesses(&mut self, accesses: &[Access]) {
        accesses.iter().for_each(|&access| self.access(access));
    }
    /// The search reads these records of a region, of `size` bytes each: an [`access`](TraceSink::access) each.
    fn records(&mut self, region: u16, size: u32, records: &[u32]) {
        for &record in records {
            self.access(Access::read(region, u64::from(record) * u64::from(size), size));
        }
    }
    /// The search is over.
    fn search_end(&mut self) {}
}
