//! The tests that every policy must pass, over a registry of them: a policy that is in it is tried.
//!
//! Each trial panics with what it found if a policy fails it; [`all`] is all of them. A crate that adds a policy of its own
//! calls it in a test:
//!
//! ```no_run
//! # use pm_caches::{Policy, policies};
//! # fn my_policy() -> &'static dyn Policy { unimplemented!() }
//! let policies = policies().with(my_policy());
//! pm_caches::trial::all(&policies);
//! ```
//!
//! Traces are random, the same on every run: of several regions, with records that span lines, writes, warm-up, and uses of
//! the same line one after another. What is right is told by the policy's own [`Definition`].

mod addresses;
mod bounds;
mod caches;
mod definition;
mod events;
mod invariance;
mod naive;
mod special_cases;

pub use addresses::addresses_may_lie_anywhere;
pub use bounds::{counts_add_up, no_policy_fetches_less_than_the_optimum};
pub use definition::{Definition, FullSet, HeldLine};
pub use invariance::{
    a_cache_does_not_depend_on_those_beside_it, chunks_one_after_another_are_the_whole,
    repeats_are_left_out_only_where_they_do_not_matter, what_is_said_to_be_forgotten_is_forgotten,
};
pub use naive::{counts_are_those_of_the_definition, fetches_are_told_as_they_happen};
pub use special_cases::{
    a_cache_of_one_set_is_full, the_first_access_may_be_to_address_zero, where_there_is_no_choice_all_are_one,
    words_are_read_as_they_are_printed,
};

use pm_registry::Registry;

use crate::Policy;
#[cfg(test)]
pub(crate) use addresses::{pages, wild_events};
pub(crate) use events::{Draw, Event, random_events, random_regions, replay, simulate};
#[cfg(test)]
pub(crate) use {
    definition::{LineAccess, line_accesses, set_of},
    naive::Cost,
};

/// All trials, on every policy that keeps lines.
///
/// # Panics
/// If one fails: a mistake in the policy, or in what it says of itself.
pub fn all(policies: &Registry<dyn Policy>) {
    words_are_read_as_they_are_printed(policies);
    the_first_access_may_be_to_address_zero(policies);
    counts_are_those_of_the_definition(policies);
    addresses_may_lie_anywhere(policies);
    fetches_are_told_as_they_happen(policies);
    repeats_are_left_out_only_where_they_do_not_matter(policies);
    chunks_one_after_another_are_the_whole(policies);
    a_cache_does_not_depend_on_those_beside_it(policies);
    what_is_said_to_be_forgotten_is_forgotten(policies);
    counts_add_up(policies);
    no_policy_fetches_less_than_the_optimum(policies);
    where_there_is_no_choice_all_are_one(policies);
    a_cache_of_one_set_is_full(policies);
}
