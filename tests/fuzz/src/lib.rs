//! Readers given what nobody would write: targets that are functions of bytes, the inputs they begin with, and a mutator.

mod mutate;
mod seeds;
mod targets;

pub use mutate::Mutator;
pub use seeds::{regressions, root, seeds};
pub use targets::{TARGETS, Target, mended, unpacked};
