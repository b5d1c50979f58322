//! From the accesses of a trace to line accesses: what the models are run over.

mod accesses;
mod attributes;
mod chunk;
mod space;

pub(crate) use accesses::{AccessBuffer, Accesses, CHUNK};
pub use attributes::Attributes;
pub(crate) use attributes::Shape;
pub use chunk::LineChunk;
pub(crate) use chunk::{Repeats, Resume};
pub use space::LineSpace;

#[cfg(test)]
mod tests;
