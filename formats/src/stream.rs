//! Typed streams of records: what most programs read and write.

mod reader;
mod writer;

pub use reader::RecordReader;
pub use writer::RecordWriter;
