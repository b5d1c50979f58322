//! Streams as text.

mod records;
mod summary;

pub use records::records;
pub use summary::{Whole, end, header, read_to_end};
