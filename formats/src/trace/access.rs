//! What a trace says: memory regions, accesses to them, and who listens.

use serde::{Deserialize, Serialize};

/// How the accesses of a region are coded in a trace; says nothing about what they mean.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Coding {
    /// Each access by its own offset and length (deltas, variable-length integers).
    Records,
    /// The region is an array of `nodes` records in which record `i - 1` is node `i` of an implicit binary tree with
    /// children `2i` and `2i + 1`; depth-first walks of it are coded as decision bits (two per inner node visited).
    HeapWalk {
        /// Number of nodes; node 1 is the root.
        nodes: u32,
        /// Each inner node is read a second time when all that is visited below it has been.
        reread: bool,
    },
}

/// One region of the traced memory. No two regions of a trace share a 4 KiB page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Region {
    /// What lives there, such as `photons` or `split planes`.
    pub name: String,
    /// First byte address; a multiple of 4096.
    pub base: u64,
    /// Size in bytes.
    pub size: u64,
    /// Bytes of one record of the region.
    pub record_size: u32,
    /// How accesses to the region are coded in the stream.
    pub coding: Coding,
}

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
    /// The search reads or writes memory.
    fn access(&mut self, access: Access);
    /// The search is over.
    fn search_end(&mut self) {}
}

/// Granularity at which regions are kept apart in the traced address space.
pub const REGION_ALIGNMENT: u64 = 4096;

/// Lays regions out one after another in one address space, each on its own pages.
#[must_use]
pub fn lay_out(regions: impl IntoIterator<Item = (String, u64, u32, Coding)>) -> Vec<Region> {
    // The first page stays empty, so that address 0 is never a valid record.
    let mut base = REGION_ALIGNMENT;
    regions
        .into_iter()
        .map(|(name, size, record_size, coding)| {
            let region = Region { name, base, size, record_size, coding };
            base += size.next_multiple_of(REGION_ALIGNMENT).max(REGION_ALIGNMENT);
            region
        })
        .collect()
}
