//! Traces, photons and queries in other programs' formats, read and written.

mod fault;
pub mod foreign;
pub mod import;
mod records;

pub use fault::{BadInput, BadQuestion, bad_input};
pub use records::records;
