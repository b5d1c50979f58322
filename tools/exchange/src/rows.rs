//! Photons and gather points of other renderers, from text or raw numbers.
//!
//! The header of a stream holds the bounds of its records, so the records wait in an unnamed temporary file until all
//! are read: memory stays bounded, pipes will do for an input, and a fault in the last row leaves no output.

mod columns;
mod photons;
mod queries;
mod reader;
mod row;
mod spool;

pub use photons::photons;
pub use queries::queries;
pub use spool::Imported;

/// How the rows of another renderer are to be understood.
#[derive(Clone, Debug)]
pub struct RowOptions {
    /// Names of the columns, `_` for one to be skipped; `None`: the first line has them.
    pub columns: Option<Vec<String>>,
    /// Records of little-endian f32, a number for each column, instead of text.
    pub raw: bool,
    /// Number of emitted paths that the powers of photons are to be divided by.
    pub emitted: u64,
    /// Width and height of the picture that queries belong to, in pixels.
    pub size: Option<[u32; 2]>,
}

#[cfg(test)]
mod tests;
