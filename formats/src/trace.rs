//! Traces: which memory each search touched, coded by search and not as addresses spelled out.

mod access;
mod archive;
mod batch;
mod bits;
mod decode;
mod encode;
mod groups;
mod heap_walk;
mod in_turns;
mod kept;
mod reader;
mod varint;
mod waits;
mod writer;

pub use crate::region::{Coding, MAX_ACCESS, MAX_IN_TURNS, REGION_ALIGNMENT, Region, lay_out};
pub use access::{Access, AccessKind, TraceSink};
pub use decode::decode_searches;
pub use encode::BlockEncoder;
pub use reader::TraceReader;
pub use waits::Waits;
pub use writer::TraceWriter;

#[cfg(test)]
mod tests;
