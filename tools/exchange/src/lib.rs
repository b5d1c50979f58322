//! Traces, photons and queries in other programs' formats, read and written.

mod fault;
mod records;
pub mod rows;
pub mod traces;
pub mod trial;

pub use fault::{BadInput, BadQuestion, bad_input};
pub use records::records;
