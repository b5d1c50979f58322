//! Cache policies: which line makes room for a new one. One file each, and a line in [`policies`].

mod chosen;
mod clock;
mod fifo;
mod lfu;
mod lru;
mod min;
mod no_cache;
mod policy;
mod random;
mod srrip;
#[cfg(test)]
mod tests;
mod tree_plru;

pub use chosen::{ChosenPolicy, UnknownPolicy};
pub(crate) use lru::Lru;
pub(crate) use min::{Min, MinBypass};
pub(crate) use no_cache::NoCache;
pub use policy::{Policy, WaysNeeded};

use pm_registry::Registry;

/// The policies there are, in the order in which they are listed.
///
/// To add one is a file beside this one and a line here; from outside, it is [`Registry::with`].
#[must_use]
pub fn policies() -> Registry<dyn Policy> {
    Registry::new(
        "policy",
        &[
            &lru::Lru,
            &fifo::Fifo,
            &clock::Clock,
            &clock::ClockClear,
            &random::Random,
            &tree_plru::TreePlru,
            &srrip::Srrip,
            &lfu::Lfu,
            &min::Min,
            &min::MinBypass,
            &no_cache::NoCache,
        ],
    )
}
