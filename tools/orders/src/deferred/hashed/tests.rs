//! Which bucket is emptied when?

use super::*;
use crate::{Per, Reordering, StoredQuery};
use bytemuck::Zeroable as _;
use pm_formats::{BlockMeta, Bounds};

/// Four cells in a row, which the hash puts into four of eight buckets.
fn order(capacity: u32) -> Reordering {
    let grid = Grid::across(&Bounds { min: [0.0; 3], max: [4.0, 1.0, 1.0] }, 4);
    let of = |x: u32| bucket([x, 0, 0], 8);
    assert!((0..4).all(|x| (0..x).all(|y| of(x) != of(y))));
    let store = Store { bytes: 1 << 20, record: StoredQuery::Full };
    Reordering::new(Per::Image, Box::new(HashBuckets::new(grid, 8, capacity, store)))
}

fn pass(order: &mut Reordering, cells: &[u8]) -> Vec<u32> {
    let queries: Vec<Query> = (0..)
        .zip(cells)
        .map(|(pixel, &cell)| Query { position: [f32::from(cell) + 0.5, 0.5, 0.5], pixel, ..Query::zeroed() })
        .collect();
    let mut out = vec![];
    let mut emit = |_: BlockMeta, queries: &[Query]| {
        out.extend(queries.iter().map(|query| query.pixel));
        Ok(())
    };
    order.push(BlockMeta::default(), &queries, &mut emit).unwrap();
    order.drain(&mut emit).unwrap();
    out
}

#[test]
fn the_fullest_bucket_is_next_and_is_emptied() {
    // Cell 1 has three queries, cell 2 two, cell 0 one.
    assert_eq!(pass(&mut order(100), &[0, 1, 2, 1, 2, 1]), [1, 3, 5, 2, 4, 0]);
}

#[test]
fn a_full_bucket_lets_the_current_one_go_until_it_has_room() {
    // The third query of cell 1 meets a full bucket: it is the fullest, and lets go one. The current bucket goes on
    // to be emptied although the other is fuller by then.
    assert_eq!(pass(&mut order(2), &[1, 1, 1, 3, 3, 3]), [0, 1, 2, 3, 4, 5]);
    assert_eq!(pass(&mut order(2), &[3, 1, 1, 1, 3]), [1, 2, 3, 0, 4]);
}
