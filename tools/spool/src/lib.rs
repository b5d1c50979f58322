//! Searches and their accesses set aside in a temporary file, to be read again from the start of any search.
//!
//! An access costs two or three bytes while region, kind and length stay as they were, sixteen when they change. The file
//! has no name and lies where temporary files do (`TMPDIR`).

mod cursor;
mod spool;
#[cfg(test)]
mod tests;
mod token;

pub use cursor::Cursor;
pub use spool::Spool;

use pm_formats::trace::Access;

/// What a spool holds, in the order it was put there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A search begins.
    Search {
        /// It is simulated but not counted.
        warm_up: bool,
        /// Pixels that it serves.
        destinations: Vec<u32>,
    },
    /// Memory is accessed.
    Access(Access),
    /// The search is over.
    SearchEnd,
}
