//! The store on chip in which queries wait: how many it has room for, and what goes to memory and back beyond.

use pm_formats::Query;

/// Bytes of a compact record: pixel and sample number in 42 bits, from which the ray is cast again, and a cell of the
/// scene in 30 bits, by which records are ordered.
pub const COMPACT_RECORD: u64 = 9;

/// Bytes of the buffer that each run or partition needs on chip, so that memory is read and written in bursts: two of
/// 128 bytes, one in use and one on its way.
pub const BURST_BUFFER: u64 = 256;

pm_registry::choices! {
    /// What is stored of a query while it waits.
    #[derive(Debug)]
    pub enum StoredQuery {
        /// All of it, 44 bytes
        Full = "full",
        /// Pixel, sample number and cell, 9 bytes; the ray is cast again
        Compact = "compact",
    }
}

impl StoredQuery {
    /// Its size in bytes.
    #[must_use]
    pub const fn bytes(self) -> u64 {
        match self {
            Self::Full => size_of::<Query>() as u64,
            Self::Compact => COMPACT_RECORD,
        }
    }
}

/// The on-chip store of an order.
#[derive(Clone, Copy, Debug)]
pub struct Store {
    /// Its size in bytes.
    pub bytes: u64,
    /// What is stored in it.
    pub record: StoredQuery,
}

impl Store {
    /// Queries for which there is room, at least one.
    #[must_use]
    pub fn room(self) -> u64 {
        (self.bytes / self.record.bytes()).max(1)
    }

    /// Runs that can be merged at once, or partitions that can be filled at once: at least two.
    #[must_use]
    pub fn fan(self) -> u64 {
        (self.bytes / BURST_BUFFER).max(2)
    }

    /// Records that are written and read again when `n` of them are sorted: by runs as long as the store, of which what
    /// fits stays on chip (Knuth, *The Art of Computer Programming* 3, 5.4), merged as many at once as have buffers.
    #[must_use]
    pub fn spilled_by_sort(self, n: u64) -> u64 {
        let beyond = n.saturating_sub(self.room());
        if beyond == 0 {
            return 0;
        }
        let (mut runs, mut passes) = (beyond.div_ceil(self.room()), 0);
        while runs > self.fan() {
            runs = runs.div_ceil(self.fan());
            passes += 1;
        }
        // While they are merged, buffers take the place of records, which go out as well.
        let pushed_out = (runs * BURST_BUFFER).div_ceil(self.record.bytes());
        (beyond + pushed_out).min(n) + passes * n
    }

    /// Passes over all records that it takes to put them into `parts` partitions.
    #[must_use]
    pub fn passes_to_part(self, parts: u64) -> u64 {
        let (mut reached, mut passes) = (self.fan(), 1);
        while reached < parts {
            reached = reached.saturating_mul(self.fan());
            passes += 1;
        }
        passes
    }
}

#[cfg(test)]
mod tests;
