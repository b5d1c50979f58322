//! Streams as text.

mod pictures;
mod summary;

pub use pictures::{Flips, comparison, picture, regions};
pub use summary::{Whole, end, header, read_to_end};
