//! In which order the nodes of an implicit binary tree lie in memory.

pm_registry::choices! {
    /// Where the nodes of a tree lie in the traced memory. The tree, and the neighbours it finds, are the same.
    #[derive(Debug, Default)]
    pub enum Layout {
        /// Level by level: children of node i at 2i and 2i + 1, no pointers
        #[default]
        Heap = "heap",
        /// Depth first: a node, its left subtree, its right subtree
        Preorder = "preorder",
        /// Van Emde Boas: the upper half of the levels, then each subtree below, all again like this
        Veb = "veb",
    }
}

impl Layout {
    /// Which record each node of a left-balanced tree of `count` nodes is, node i at index i - 1; nothing if it is record
    /// i - 1.
    pub(super) fn records(self, count: usize) -> Vec<u32> {
        match self {
            Self::Heap => vec![],
            Self::Preorder => preorder(count),
            Self::Veb => van_emde_boas(count),
        }
    }
}

/// The record of `node`, given what [`Layout::records`] said.
#[inline(always)]
pub(super) fn record_of(records: &[u32], node: usize) -> u32 {
    records.get(node - 1).copied().unwrap_or((node - 1) as u32)
}

/// Number of nodes in the left subtree of a left-balanced tree of `n` nodes: all levels full but the last, which fills
/// from the left.
pub(super) fn left_size(n: usize) -> usize {
    if n < 2 {
        return 0;
    }
    let full = 1 << n.ilog2();
    let last = n - (full - 1);
    (full / 2 - 1) + last.min(full / 2)
}

fn preorder(count: usize) -> Vec<u32> {
    let mut records = vec![0; count];
    // Subtrees yet to be laid out, the next one last.
    let mut subtrees = vec![1];
    let mut next = 0;
    while let Some(node) = subtrees.pop() {
        if node <= count {
            records[node - 1] = next;
            next += 1;
            subtrees.extend([2 * node + 1, 2 * node]);
        }
    }
    records
}

/// Prokop, *Cache-oblivious algorithms*, MIT 1999, section 10.2: any path from the root crosses O(log n / log B) lines,
/// whatever the number B of nodes a line holds.
fn van_emde_boas(count: usize) -> Vec<u32> {
    let mut records = vec![0; count];
    let mut next = 0;
    if count > 0 {
        lay_out_levels(1, count.ilog2() + 1, &mut records, &mut next);
    }
    records
}

/// Lays out the `levels` upper levels of the subtree of `root`.
fn lay_out_levels(root: usize, levels: u32, records: &mut [u32], next: &mut u32) {
    if root > records.len() {
        return;
    }
    if levels == 1 {
        records[root - 1] = *next;
        *next += 1;
        return;
    }
    let upper = levels / 2;
    lay_out_levels(root, upper, records, next);
    for below in (root << upper)..((root + 1) << upper) {
        lay_out_levels(below, levels - upper, records, next);
    }
}

#[cfg(test)]
mod tests;
