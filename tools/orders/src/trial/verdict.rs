//! What a trial says, and the store that all of them give.

use crate::{Store, StoredQuery};

/// An order does not do what an order does.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{order}: {what}")]
pub struct Fault {
    /// The order, as it was asked for.
    pub order: String,
    /// What it did, and on what.
    pub what: String,
}

/// What a trial says.
pub type Verdict = Result<(), Fault>;

/// Bytes of the store in trials.
pub const STORAGE: u64 = 32 << 10;
/// The store of trials.
pub const STORE: Store = Store { bytes: STORAGE, record: StoredQuery::Full };
