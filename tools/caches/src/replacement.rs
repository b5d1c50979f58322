//! Which line of a full set makes room: what every policy of sets and ways has to say.

mod clock;
mod fifo;
mod lru_order;
mod lru_times;
mod random;
mod tree_plru;

pub(super) use {
    clock::Clock, fifo::Fifo, lru_order::LruOrder, lru_times::LruTimes, random::Random, tree_plru::TreePlru,
};

/// A replacement policy, told what happens in the ways of each set.
///
/// A way is filled when a line enters it while it is empty, the lowest first, or takes a victim's place; the cache asks for
/// a victim only where every way of the set is filled, and fills it next.
pub(super) trait Replacement {
    /// The line in `way` of `set` is used again.
    fn hit(&mut self, set: usize, way: usize);
    /// A new line enters `way` of `set`.
    fn fill(&mut self, set: usize, way: usize);
    /// Which way of the full set gives up its line.
    fn victim(&mut self, set: usize) -> usize;
}
