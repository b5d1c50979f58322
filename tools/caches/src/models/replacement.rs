//! Which line of a full set makes room: what every policy of sets and ways has to say.

/// The state of a replacement policy, told what happens in the ways of each set.
///
/// A way is filled when a line enters it while it is empty, the lowest first, or takes a victim's place; the cache asks for
/// a victim only where every way of the set is filled, and fills it next.
pub trait Replacement {
    /// Whether it makes a difference that a line is used again right after it was used.
    ///
    /// False says: two calls of [`hit`](Self::hit) for the same way in a row are as good as one, and a hit of the way that
    /// was just filled is as good as none. Then nearly all such accesses are left out, which saves time. A policy that counts
    /// uses needs them.
    const REPEATS_MATTER: bool = true;

    /// The line in `way` of `set` is used again.
    fn hit(&mut self, set: usize, way: usize);
    /// A new line enters `way` of `set`.
    fn fill(&mut self, set: usize, way: usize);
    /// Which way of the full set gives up its line.
    fn victim(&mut self, set: usize) -> usize;
}
