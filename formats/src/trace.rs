//! Traces: which memory each search touched.

mod access;

pub use access::{Access, AccessKind, Coding, REGION_ALIGNMENT, Region, TraceSink, lay_out};
