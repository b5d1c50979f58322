//! Traces: which memory each search touched, coded by search and not as addresses spelled out.

mod access;
mod decode;
mod encode;
mod heap_walk;
mod stream;
mod varint;

pub use access::{Access, AccessKind, Coding, REGION_ALIGNMENT, Region, TraceSink, lay_out};
pub use decode::decode_searches;
pub use encode::BlockEncoder;
pub use stream::{TraceReader, TraceWriter};

#[cfg(test)]
mod tests;
