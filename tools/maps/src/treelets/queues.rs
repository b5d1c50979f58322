//! Queues of searches, of which the longest is next.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Searches by the treelet at which they wait.
#[derive(Default)]
pub(super) struct Queues {
    waiting: BTreeMap<u32, Vec<u32>>,
    /// Length and treelet of each queue, the longest last; of equally long ones that of the first treelet.
    lengths: BTreeSet<(usize, Reverse<u32>)>,
}

impl Queues {
    /// A search begins to wait.
    pub(super) fn push(&mut self, treelet: u32, search: u32) {
        let queue = self.waiting.entry(treelet).or_default();
        self.lengths.remove(&(queue.len(), Reverse(treelet)));
        queue.push(search);
        self.lengths.insert((queue.len(), Reverse(treelet)));
    }

    /// The treelet with the longest queue, and who waits there, as they came.
    pub(super) fn pop(&mut self) -> Option<(u32, Vec<u32>)> {
        let (_, Reverse(treelet)) = self.lengths.pop_last()?;
        self.waiting.remove(&treelet).map(|queue| (treelet, queue))
    }
}
