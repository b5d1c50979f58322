//! Does every node have an address of its own, where the layout says?

use super::*;

#[test]
fn preorder_puts_a_node_before_its_left_subtree_before_its_right() {
    // Six nodes: 1 (2 (4 5) 3 (6)).
    assert_eq!(preorder(6), [0, 1, 4, 2, 3, 5]);
    assert_eq!(preorder(0), [0; 0]);
}

#[test]
fn van_emde_boas_puts_the_upper_levels_before_each_subtree_below() {
    // Four levels: 1 2 3, then the subtrees of 4, 5, 6 and 7.
    assert_eq!(van_emde_boas(15), [0, 1, 2, 3, 6, 9, 12, 4, 5, 7, 8, 10, 11, 13, 14]);
    // Three levels: the root alone above, then the subtrees of 2 and 3; node 7 is not there.
    assert_eq!(van_emde_boas(6), [0, 1, 4, 2, 3, 5]);
}

#[test]
fn every_node_is_a_record_of_its_own() {
    for layout in [Layout::Preorder, Layout::Veb] {
        for count in (0..70).chain([1000, 1023, 1024, 1025]) {
            let mut records = layout.records(count);
            records.sort_unstable();
            assert!(records.into_iter().eq(0..count as u32), "{layout:?} {count}");
        }
    }
}

#[test]
fn a_path_crosses_fewer_lines_in_van_emde_boas_order() {
    // Lines of 7 nodes and 15 levels: heap order has three levels in the first line and then nearly a line per level.
    let count = (1 << 15) - 1;
    let lines = |layout: Layout| {
        let records = layout.records(count);
        (1 << 14..1 << 15)
            .map(|leaf: usize| {
                let mut path: Vec<u32> = (0..15).map(|up| record_of(&records, leaf >> up) / 7).collect();
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
