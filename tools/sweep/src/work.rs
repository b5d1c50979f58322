//! What make runs for a point.

/// A stream that points have in common: make runs its command with `-o FILE` behind it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream {
    /// Its file.
    pub file: String,
    /// Files that must be there first.
    pub needs: Vec<String>,
    /// What makes it, as make reads it.
    pub command: String,
}

/// What a point runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Work {
    /// Streams that are made first, each behind those that it needs.
    pub streams: Vec<Stream>,
    /// Files that must be there first.
    pub needs: Vec<String>,
    /// What prints the row, as make reads it.
    pub command: String,
    /// The part of it that makes a trace, if the rest simulates caches over that; the two are piped together.
    pub gathers: Option<String>,
}
