//! What can be chosen by a word: on a command line, in a table, in an error.
//!
//! A [`Choice`] is a closed set, an `enum` made by [`choices!`]: each line is a variant, its word and what is said of it.
//! A [`Registry`] is an open one: a list of things that each know their own word, to which a line adds one more. From that
//! line come the word on the command line, the help, the error text, the row in a table of documentation, and the place in
//! every test that says "for every".

mod choice;
mod registry;

pub use choice::{Choice, Named};
pub use registry::{Registered, Registry, UnknownWord};
