//! Which line of a full set makes room: what every policy of sets and ways has to say.

mod clock;
mod fifo;
mod lru;
mod random;
mod tree_plru;

pub(super) use {clock::Clock, fifo::Fifo, lru::Lru, random::Random, tree_plru::TreePlru};

/// A replacement policy over *frames*, the places for lines; set s owns frames s * ways to s * ways + ways - 1.
///
/// A frame is filled when a line enters an empty place of its set, the lowest first, or takes a victim's; the cache asks
/// for a victim only where every frame of the set is filled, and fills it next.
pub(super) trait Replacement {
    /// The line in `frame` is used again.
    fn hit(&mut self, frame: usize);
    /// A new line enters `frame`.
    fn fill(&mut self, frame: usize);
    /// Which way of the full set gives up its line: from 0 to ways - 1.
    fn victim(&mut self, set: usize) -> usize;
}
