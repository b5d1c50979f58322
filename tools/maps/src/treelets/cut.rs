//! A left-balanced tree cut into treelets: subtrees of so many levels, whole at the bottom, with what is left of the levels at the top.

/// Where the tree is cut. A treelet is known by its uppermost node.
pub(super) struct Cut {
    levels: u32,
    /// Levels of the treelet at the root.
    top: u32,
    /// Levels of every other.
    each: u32,
}

impl Cut {
    /// Of a tree of `count` nodes into treelets of `most` nodes at most.
    pub(super) fn new(count: usize, most: usize) -> Self {
        let levels = (count + 1).next_power_of_two().ilog2();
        let each = (most + 1).ilog2().max(1);
        let top = match levels % each {
            0 => each,
            rest => rest,
        };
        Self { levels, top, each }
    }

    /// Levels of the tree.
    pub(super) const fn levels(&self) -> usize {
        self.levels as usize
    }

    /// The treelet that a node belongs to.
    #[inline]
    pub(super) const fn treelet(&self, node: u32) -> u32 {
        let depth = node.ilog2();
        if depth < self.top { 1 } else { node >> ((depth - self.top) % self.each) }
    }

    /// Treelet by treelet, and level by level within one: which record each of `count` nodes is, node i at index i - 1.
    pub(super) fn records(&self, count: usize) -> Vec<u32> {
        let mut nodes: Vec<(u32, u32)> = (1..=count as u32).map(|node| (self.treelet(node), node)).collect();
        nodes.sort_unstable();
        let mut records = vec![0; count];
        for (record, (_, node)) in (0..).zip(nodes) {
            records[node as usize - 1] = record;
        }
        records
    }

    /// Treelets of `count` nodes.
    pub(super) fn treelets(&self, count: usize) -> u64 {
        (1..=count as u32).filter(|&node| self.treelet(node) == node).count() as u64
    }
}
