//! The targets, by name.

mod foreign;
mod mend;
mod parts;
mod scenes;
mod streams;
mod tables;

pub use mend::{mended, unpacked};
pub use streams::archive;

/// A reader that is tried.
pub struct Target {
    /// Its name.
    pub name: &'static str,
    /// Reads bytes; comes back, whatever they are.
    pub run: fn(&[u8]),
}

/// All of them.
pub const TARGETS: [Target; 7] = [
    Target { name: "streams", run: streams::any },
    Target { name: "mended", run: streams::mended },
    Target { name: "parts", run: parts::together },
    Target { name: "traces", run: foreign::traces },
    Target { name: "rows", run: foreign::rows },
    Target { name: "scenes", run: scenes::load },
    Target { name: "tables", run: tables::read },
];
