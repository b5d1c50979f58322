//! Traces in other simulators' formats, read and written.
//!
//! A format is a file in `formats`, which knows what one entry looks like, and a line in [`imports`], in [`exports`] or in
//! both. Reading makes a [`Trace`], which replays into the same sinks as a trace of ours; writing is an [`Exporter`], itself
//! such a sink. What a foreign trace does not have: searches, so nothing is per query, and regions: there is one, which is
//! all addresses.

mod archive;
mod beyond;
mod entries;
mod export;
mod exporter;
mod formats;
mod import;
mod in_blocks;
mod known;
mod open;
mod part;
mod pieces;
mod reading;
mod recognise;
mod reference;
mod registries;
mod table;
pub mod text;
mod trace;
mod unpack;

pub use archive::{archive, header_of};
pub use export::{Carried, Kinds, PieceWriter, TraceExport, Unwritten};
pub use exporter::Exporter;
pub use import::{AssumedSize, EntryParser, EntryShape, Example, ParserOfColumns, Recognition, Sizes, TraceImport};
pub use open::{Opened, open};
pub use part::Part;
pub use pieces::Piece;
pub use reading::{Reading, References};
pub use reference::{EntryKind, Numbered, Parsed, Reference};
pub use registries::{exports, imports};
pub use table::{assumed_sizes, table};
pub use trace::Trace;

#[cfg(test)]
mod tests;
