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
    pub(super) fn places(self, count: usize) -> Vec<u32> {
        match self {
            Self::Heap => vec![],
            Self::Preorder => preorder(count),
            Self::Veb => van_emde_boas(count),
        }
    }
}

/// The record of `node`, given what [`Layout::places`] said.
#[inline(always)]
pub(super) fn place(places: &[u32], node: usize) -> u32 {
    places.get(node - 1).copied().unwrap_or((node - 1) as u32)
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
    let mut places = vec![0; count];
    // Subtrees yet to be placed, the next one last.
    let mut subtrees = vec![1];
    let mut next = 0;
    while let Some(node) = subtrees.pop() {
        if node <= count {
            places[node - 1] = next;
            next += 1;
            subtrees.extend([2 * node + 1, 2 * node]);
        }
    }
    places
}

/// Prokop, *Cache-oblivious algorithms*, MIT 1999, section 10.2: any path from the root crosses O(log n / log B) lines,
/// whatever the number B of nodes a line holds.
fn van_emde_boas(count: usize) -> Vec<u32> {
    let mut places = vec![0; count];
    let mut next = 0;
    if count > 0 {
        place_levels(1, count.ilog2() + 1, &mut places, &mut next);
    }
    places
}

/// Places the `levels` upper levels of the subtree of `root`.
fn place_levels(root: usize, levels: u32, places: &mut [u32], next: &mut u32) {
    if root > places.len() {
        return;
    }
    if levels == 1 {
        places[root - 1] = *next;
        *next += 1;
        return;
    }
    let upper = levels / 2;
    place_levels(root, upper, places, next);
    for below in (root << upper)..((root + 1) << upper) {
        place_levels(below, levels - upper, places, next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn preorder_places_a_node_before_its_left_subtree_before_its_right() {
        // Six nodes: 1 (2 (4 5) 3 (6)).
        assert_eq!(preorder(6), [0, 1, 4, 2, 3, 5]);
        assert_eq!(preorder(0), [0; 0]);
    }

    #[test]
    fn van_emde_boas_places_the_upper_levels_before_each_subtree_below() {
        // Four levels: 1 2 3, then the subtrees of 4, 5, 6 and 7.
        assert_eq!(van_emde_boas(15), [0, 1, 2, 3, 6, 9, 12, 4, 5, 7, 8, 10, 11, 13, 14]);
        // Three levels: the root alone above, then the subtrees of 2 and 3; node 7 is not there.
        assert_eq!(van_emde_boas(6), [0, 1, 4, 2, 3, 5]);
    }

    #[test]
    fn every_node_has_a_place_of_its_own() {
        for layout in [Layout::Preorder, Layout::Veb] {
            for count in (0..70).chain([1000, 1023, 1024, 1025]) {
                let mut places = layout.places(count);
                places.sort_unstable();
                assert!(places.into_iter().eq(0..count as u32), "{layout:?} {count}");
            }
        }
    }

    #[test]
    fn a_path_crosses_fewer_lines_in_van_emde_boas_order() {
        // Lines of 7 nodes and 15 levels: heap order has three levels in the first line and then nearly a line per level.
        let count = (1 << 15) - 1;
        let lines = |layout: Layout| {
            let places = layout.places(count);
            (1 << 14..1 << 15)
                .map(|leaf: usize| {
                    let mut path: Vec<u32> = (0..15).map(|up| place(&places, leaf >> up) / 7).collect();
                    path.dedup();
                    path.len()
                })
                .sum::<usize>()
        };
        assert!(lines(Layout::Veb) * 3 < lines(Layout::Heap) * 2, "{} {}", lines(Layout::Veb), lines(Layout::Heap));
    }

    #[test]
    fn the_left_subtree_fills_the_last_level_from_the_left() {
        let sizes: Vec<_> = (0..=15).map(left_size).collect();
        assert_eq!(sizes, [0, 0, 1, 1, 2, 3, 3, 3, 4, 5, 6, 7, 7, 7, 7, 7]);
    }
}
