//! How events are coded: tokens, and accesses as differences from the one before.

use pm_formats::trace::Access;

/// The access before, from which the next differs little.
#[derive(Clone, Copy)]
pub(crate) struct Last(pub(crate) Access);

impl Last {
    pub(crate) const START: Self = Self(Access::read(0, 0, 0));
}

/// Low bits of a token, what follows, and what is in its upper bits:
/// an access like the last but for its offset; the zigzag difference.
pub(crate) const NEAR: u64 = 0;
/// An access spelled out in the 15 bytes that follow.
pub(crate) const FAR: u64 = 1;
/// A search; 2 x number of destinations + warm-up. The destinations follow.
pub(crate) const SEARCH: u64 = 2;
/// The end of a search.
pub(crate) const END: u64 = 3;

/// No token or destination takes more bytes: a varint, and an access spelled out.
pub(crate) const MOST_BYTES: usize = 10 + 15;
