//! Streams as text, text as streams.

mod import;
mod pictures;
mod records;
mod summary;

pub use import::{Import, Imported, photons as import_photons, queries as import_queries};
pub use pictures::{Flips, comparison, picture, regions};
pub use records::records;
pub use summary::{Whole, end, header, read_to_end};
