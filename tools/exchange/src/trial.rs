//! Tests of every format in given registries, for those who add one: what each must do, whatever it looks like.
//!
//! All functions panic where a format does not do it, and say which format and what.

mod accesses;
mod exports;
mod imports;

pub use exports::exports;
pub use imports::imports;
