//! What can be wrong with parts of a stream.

use crate::error::Error;

/// Why parts are not put together.
#[derive(Debug, thiserror::Error)]
pub enum PartsError {
    /// They are not all parts of one stream, each once: others have to be given.
    #[error("{0}")]
    Unfit(String),
    /// One of them cannot be read, or is damaged.
    #[error("{name}: {error}")]
    Stream {
        /// How the part is called.
        name: String,
        /// What is wrong with it.
        #[source]
        error: Error,
    },
}
