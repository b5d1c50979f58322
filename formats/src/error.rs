//! What can be wrong with a stream.

use std::io;

/// Why a stream could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The operating system refused to read or write.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The bytes are no stream of ours.
    #[error("this is not a pm stream (it does not begin with its signature); was it made by a pm program?")]
    NotAStream,
    /// The stream is of another format version.
    #[error(
        "the stream has format version {found}, this program reads version {known}; \
         make it again or use the programs that made it"
    )]
    Version {
        /// Version found in the stream.
        found: u16,
        /// Version this library reads and writes.
        known: u16,
    },
    /// The stream holds other records than those asked for.
    #[error("the stream holds {found}, but {wanted} are needed here")]
    WrongKind {
        /// What the stream holds.
        found: &'static str,
        /// What was asked for.
        wanted: &'static str,
    },
    /// The stream stops before its end block.
    #[error(
        "after {blocks} blocks, {records} records: the stream stops before its end block; \
         the program before this one did not finish"
    )]
    Incomplete {
        /// Whole blocks read.
        blocks: u64,
        /// Records in those blocks.
        records: u64,
    },
    /// The stream contradicts itself: bytes were changed, lost or added.
    #[error("the stream is damaged at block {block}: {what}; make it again")]
    Damaged {
        /// Number of the block, counted from 0; the header is damaged if `what` says so.
        block: u64,
        /// What does not fit.
        what: &'static str,
    },
    /// What was given to be written cannot be said in this format.
    #[error("cannot be written to a stream: {0}")]
    Invalid(String),
}

impl Error {
    /// True if the fault lies in the stream's bytes and not in the system or the request.
    #[must_use]
    pub fn is_damage(&self) -> bool {
        !matches!(self, Self::Io(_) | Self::Invalid(_))
    }
}

/// Shorthand for results of this library.
pub type Result<T> = std::result::Result<T, Error>;
