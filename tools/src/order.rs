//! Orders of queries: generative ones decide which pixel comes next, deferred ones permute what was generated.

mod buffered;
mod charge;
mod cost;
mod external;
mod generative;
mod hashed;
mod median_split;
mod partition;
mod snowplow;
mod sorted;

pub use buffered::Buffered;
pub use charge::Charge;
pub use cost::{BURST_BUFFER, COMPACT_RECORD, Record, Store};
pub use generative::{Generative, Leaves, Pass, Span};
pub use hashed::Hashed;
pub use median_split::MedianSplit;
pub use partition::Partition;
pub use snowplow::Snowplow;
pub use sorted::{Limits, Sorted};

use pm_formats::{BlockMeta, Number, Query};

/// How far an order may look.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Per {
    /// Each batch (tile or scanline) by itself, as it stands in the stream
    Batch,
    /// The whole image, which then is one batch
    Image,
}

impl Per {
    /// What is to be held together with queries of this block.
    const fn batch_of(self, meta: BlockMeta) -> BlockMeta {
        match self {
            Self::Batch => BlockMeta { records: 0, ..meta },
            Self::Image => BlockMeta { batch: 0, warm_up: false, records: 0 },
        }
    }
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
