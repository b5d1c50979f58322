//! Evicts the line that a binary tree of bits over the ways of the set points away from.

use super::Replacement;

/// Tree pseudo-LRU: at each inner node of a complete binary tree over the ways, which half was *not* used last.
///
/// A use makes the nodes above its way point to the other half; the victim is where the nodes point to. With two ways that
/// is LRU.
pub(in super::super) struct TreePlru {
    /// Of each node, whether it points to the upper half. Node 1 of a set is the root, node n has children 2n and 2n + 1,
    /// way w hangs below as node ways + w. Set s owns `upper[s * ways..][..ways]`, node 0 of which is no node.
    upper: Vec<bool>,
    /// log2 of the ways.
    levels: u32,
}

impl TreePlru {
    /// `ways` is a power of two.
    pub(in super::super) fn new(sets: usize, ways: usize) -> Self {
        assert!(ways.is_power_of_two());
        Self { upper: vec![false; sets * ways], levels: ways.ilog2() }
    }
}

impl Replacement for TreePlru {
    #[inline]
    fn hit(&mut self, set: usize, way: usize) {
        let ways = 1_usize << self.levels;
        let nodes = &mut self.upper[set << self.levels..][..ways];
        let mut node = ways + way;
        while node > 1 {
            nodes[node / 2] = node.is_multiple_of(2);
            node /= 2;
        }
    }

    #[inline]
    fn fill(&mut self, set: usize, way: usize) {
        self.hit(set, way);
    }

    #[inline]
    fn victim(&mut self, set: usize) -> usize {
        let ways = 1_usize << self.levels;
        let nodes = &self.upper[set << self.levels..][..ways];
        let node = (0..self.levels).fold(1, |node, _| 2 * node + usize::from(nodes[node]));
        node - ways
    }
}
