//! Orders of queries: generative ones decide which pixel comes next, deferred ones permute what was generated.
//!
//! A deferred order is a file in `deferred` that implements [`Order`], and a line in [`orders`]; what it does with queries
//! is a [`Reorder`], and [`Reordering`] applies that to a stream. A generative order is a file in `generative` that implements
//! [`GenerativeOrder`], and a line in [`generative_orders`]. [`trial`] holds what every order must pass.

mod arrivals;
mod by_key;
mod charge;
mod costs;
mod deferred;
mod generative;
mod median_split;
mod order;
mod partitions;
mod reorder;
mod reordering;
mod runs;
mod sample;
mod sorted;
mod store;
pub mod trial;

pub use charge::Charge;
pub use costs::Costs;
pub use deferred::orders;
pub use generative::{Generative, GenerativeOrder, Pass, PixelRun, Span, VisiblePoints, generative_orders};
pub use median_split::MedianSplit;
pub use order::{Keys, Order, Setting};
pub use partitions::Partitions;
pub use reorder::{Emit, Outlet, Reorder};
pub use reordering::{Per, Reordering};
pub use sorted::{Limits, Sorted};
pub use store::{BURST_BUFFER, COMPACT_RECORD, Store, StoredQuery};

#[cfg(test)]
mod tests;
