//! The deferred orders: a file each, and a line here.

#[cfg(test)]
mod as_charged;
mod buffered;
mod cells;
mod hashed;
mod hilbert;
mod hint;
mod hybrid;
mod leaf;
mod morton;
mod parameters;
mod partition;
mod radius;
mod random;
mod residents;
mod snowplow;

use super::Order;
use pm_registry::Registry;

/// The deferred orders that there are.
#[must_use]
pub fn orders() -> Registry<dyn Order> {
    Registry::new(
        "order",
        &[
            &hilbert::Hilbert,
            &morton::Morton,
            &leaf::Leaf,
            &random::Random,
            &hashed::Hashed,
            &hint::Hint,
            &partition::Partition,
            &cells::Cells,
            &hybrid::Hybrid,
            &radius::Radius,
            &snowplow::Snowplow,
            &buffered::Buffered,
        ],
    )
}
