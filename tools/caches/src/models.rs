//! What is simulated: models of caches, run over the line accesses of a trace.

mod cache_on_trace;
mod lru_stack;
mod optimum;
mod replacement;
mod set_associative;
mod sets;
mod uncached;

pub use cache_on_trace::CacheOnTrace;
pub(crate) use lru_stack::{MAX_SIZES, lru_stack};
pub(crate) use optimum::{Bypass, FewWays, OneSet, Optimum};
pub use replacement::Replacement;
pub(crate) use set_associative::{MAX_FRAMES, SetAssociative};
pub(crate) use sets::Sets;
pub(crate) use uncached::Uncached;

use crate::{
    lines::{LineChunk, LineSpace},
    misses::Misses,
};

/// A cache, or several of one line size, that line accesses are run through.
///
/// Called once for some thousand line accesses, so that the call costs nothing and the loop inside knows its policy.
pub trait CacheModel {
    /// Runs the line accesses of `chunk`; `counted` is false during warm-up, when only the state changes. Tells `misses`
    /// of each miss, in order.
    fn run(&mut self, space: &LineSpace, chunk: &LineChunk, counted: bool, misses: &mut Misses);

    /// What came of it, for each cache of the model in the order it was built with.
    fn finish(self: Box<Self>) -> Vec<LineCounts>;

    /// Whether it tells [`Misses::write_back`] of each dirty line that leaves.
    fn tells_write_backs(&self) -> bool {
        false
    }

    /// Whether an access that repeats the one before (same line, same region, same kind) makes a difference. Where it makes
    /// none for any model of a line size such accesses are left out of the chunks, all but some.
    fn repeats_matter(&self) -> bool {
        true
    }
}

/// What a model counts, in lines. What warm-up does is not counted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LineCounts {
    /// Lines fetched for accesses to each region.
    pub fetches: Vec<u64>,
    /// Lines fetched that were never touched before.
    pub compulsory: u64,
    /// Lines that turned dirty, and so are written back once each.
    pub write_backs: u64,
}

impl LineCounts {
    /// Nothing yet, in a trace of so many regions.
    #[must_use]
    pub fn new(regions: usize) -> Self {
        Self { fetches: vec![0; regions], ..Self::default() }
    }
}

/// A model, and the caches that it answers for.
pub struct Modelled {
    /// The model.
    pub model: Box<dyn CacheModel>,
    /// Which of the caches it was asked to model, and which of its counts are theirs.
    pub answers: Vec<Answer>,
}

/// A cache, and the counts of a model that are its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer {
    /// Index of the cache, among those to be modelled.
    pub cache: usize,
    /// Index into the model's counts. Where a model tells of a miss in its first n caches, it is in those below n.
    pub counts: usize,
}

impl Modelled {
    /// A model of one cache alone.
    #[must_use]
    pub fn one(cache: usize, model: Box<dyn CacheModel>) -> Self {
        Self { model, answers: vec![Answer { cache, counts: 0 }] }
    }
}
