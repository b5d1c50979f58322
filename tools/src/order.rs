//! Orders of queries: generative ones decide which pixel comes next, deferred ones permute what was generated.

mod generative;
mod hilbert;
mod sorted;

pub use generative::{Generative, Leaves, Pass, Span};
pub use hilbert::{HILBERT_BITS, hilbert_key, hilbert_keys};
pub use sorted::Sorted;

use pm_formats::{BlockMeta, Number, Query};

/// How far an order may look.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Per {
    /// Each batch (tile or scanline) by itself, as it stands in the stream
    Batch,
    /// The whole image, which then is one batch
    Image,
}

/// Takes what a reordering lets go: the block it belongs to, and its queries.
pub type Emit<'a> = dyn FnMut(BlockMeta, &[Query]) -> pm_formats::Result<()> + 'a;

/// A deferred order. Every query pushed is emitted exactly once, by the end of `drain` at the latest.
pub trait Reorder {
    /// Takes queries of one block; may emit some that it holds.
    ///
    /// # Errors
    /// Those of `emit`.
    fn push(&mut self, meta: BlockMeta, queries: &[Query], emit: &mut Emit<'_>) -> pm_formats::Result<()>;

    /// Emits all that is held.
    ///
    /// # Errors
    /// Those of `emit`.
    fn drain(&mut self, emit: &mut Emit<'_>) -> pm_formats::Result<()>;

    /// What the order cost, for the end block.
    fn measures(&self) -> Vec<(String, Number)>;
}

#[cfg(test)]
mod tests;
