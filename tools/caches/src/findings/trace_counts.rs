//! What a trace counts at one line size.

use super::RecordCounts;

/// What a trace counts before any cache, at one line size. All counts leave warm-up out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TraceCounts {
    /// Line in bytes.
    pub line_bytes: u32,
    /// Queries answered.
    pub queries: u64,
    /// Record accesses over all regions.
    pub records: RecordCounts,
    /// Line accesses.
    pub accesses: u64,
    /// Blocks of memory: bytes of all regions over bytes of a line, rounded up.
    pub blocks: u64,
}
