//! What programs say to each other in words: every name that one of them writes into a stream and another reads.
//!
//! Names of meanings in a header stand in [`meaning`], names of measures in an end block in [`measure`]; values that are
//! taken apart by their reader have a type, which writes and reads the same text. Whoever writes or reads one takes it from
//! here, so that a name cannot be said in one way and be heard in another.

pub mod meaning;
pub mod measure;
mod order;
mod part;
mod sample;

pub use order::{DeferredLabel, OrderLabel};
pub use part::Part;
pub use sample::SampleUnit;

/// The text is not what its place in a header calls for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is no {what}")]
pub struct UnknownText {
    /// What was expected, with an example.
    pub what: &'static str,
    /// What stands there.
    pub text: String,
}
