//! What every simulated cache has in common.

use super::{
    lines::{LineChunk, LineSpace},
    misses::Misses,
};

/// A cache, or several of one line size, that line accesses are run through.
///
/// Called once for some thousand line accesses, so that the call costs nothing and the loop inside knows its policy.
pub(super) trait CacheModel {
    /// Runs the line accesses of `chunk`; `counted` is false during warm-up, when only the state changes. Tells `misses`
    /// of each miss, in order.
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses);

    /// What came of it, for each cache of the model in the order it was built with.
    fn finish(self: Box<Self>) -> Vec<Tally>;
}

/// What a model counts, in lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    /// Lines fetched for accesses to each region.
    pub(super) fetches: Vec<u64>,
    /// Lines fetched that were never touched before.
    pub(super) compulsory: u64,
    /// Lines that turned dirty, and so are written back once each.
    pub(super) write_backs: u64,
}
