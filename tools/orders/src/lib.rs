//! Orders of queries: generative ones decide which pixel comes next, deferred ones permute what was generated.

mod buffered;
mod charge;
mod cost;
mod external;
mod generative;
mod hashed;
mod median_split;
mod partition;
mod reordering;
mod snowplow;
mod sorted;

pub use buffered::Buffered;
pub use charge::Charge;
pub use cost::{BURST_BUFFER, COMPACT_RECORD, Record, Store};
pub use generative::{Generative, Leaves, Pass, Span};
pub use hashed::Hashed;
pub use median_split::MedianSplit;
pub use partition::Partition;
pub use reordering::{Emit, Outlet, Per, Reordering};
pub use snowplow::Snowplow;
pub use sorted::{Limits, Sorted};

use pm_formats::{Number, Query};

/// A deferred order of the queries of a batch. Every query pushed leaves exactly once, by the end of `drain` at the latest;
/// after that the next batch may come.
pub trait Reorder {
    /// Takes queries; may let some go that it holds.
    ///
    /// # Errors
    /// Those of `out`, and of temporary files.
    fn push(&mut self, queries: &[Query], out: &mut Outlet<'_>) -> pm_formats::Result<()>;

    /// Lets go all that it holds.
    ///
    /// # Errors
    /// Those of `out`, and of temporary files.
    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()>;

    /// What the order cost, for the end block.
    fn measures(&self) -> Vec<(String, Number)>;
}

#[cfg(test)]
mod tests;
