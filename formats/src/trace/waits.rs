//! What a read of a search waits for.

/// Which reads of its search have to be there before it is known where a read goes.
///
/// Reads have *levels*. What is told is which records lead to which, and nothing else: a read at level 0 could be made as soon
/// as the search is asked for, one below as soon as those are there that it waits for. That a search which looks at one
/// record after the other may have learnt meanwhile that it need not go there is no waiting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Waits(u16);

impl Waits {
    /// Level 0: its address follows from the query.
    pub const NOTHING: Self = Self(0);
    /// Level 0, and it waits for all reads of the search before it, as all reads of level 0 behind it do: an attempt begins
    /// because the one before did not find enough.
    pub const ALL_BEFORE: Self = Self(1);
    /// The deepest level.
    pub const DEEPEST: u16 = (1 << 15) - 1;

    /// At this level, for the one read of the level above that was made last: in a walk of a tree that goes depth first, the
    /// parent. At level 0, nothing.
    ///
    /// # Panics
    /// If that is deeper than [`DEEPEST`](Self::DEEPEST).
    #[inline]
    #[must_use]
    pub const fn last_above(level: u16) -> Self {
        assert!(level <= Self::DEEPEST);
        Self(level << 1)
    }

    /// At this level, for every read of the level above in the same attempt. At level 0, [`ALL_BEFORE`](Self::ALL_BEFORE).
    ///
    /// # Panics
    /// If that is deeper than [`DEEPEST`](Self::DEEPEST).
    #[inline]
    #[must_use]
    pub const fn all_above(level: u16) -> Self {
        assert!(level <= Self::DEEPEST);
        Self(level << 1 | 1)
    }

    /// How many levels lie above it.
    #[inline]
    #[must_use]
    pub const fn level(self) -> u16 {
        self.0 >> 1
    }

    /// Does it wait for every read of the level above, or, at level 0, of the search?
    #[inline]
    #[must_use]
    pub const fn is_for_all(self) -> bool {
        self.0 & 1 == 1
    }

    /// As a trace has it.
    pub(super) const fn code(self) -> u64 {
        self.0 as u64
    }

    /// What a trace says, of a search whose reads so far were at `levels` levels from 0 on; `None` if there is none to wait for.
    pub(super) fn of_code(code: u64, levels: u16) -> Option<Self> {
        let waits = Self(u16::try_from(code).ok()?);
        (waits.level() <= levels).then_some(waits)
    }
}
