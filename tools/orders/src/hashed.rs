//! The paper's hashed order: a window of queries, sorted into buckets by the cell of the scene that they lie in.
//!
//! Steinhurst, Coombe, Lastra, GI 2005, section 3.2. The paper does not state its hash; this is that of Teschner,
//! Heidelberger, Müller, Pomeranets, Gross, *Optimized Spatial Hashing for Collision Detection of Deformable Objects*,
//! VMV 2003.

use super::cost::{Costs, Store};
use super::{Outlet, Reorder};
use pm_curves::Grid;
use pm_formats::{Number, Query};
use std::collections::VecDeque;

/// Bytes of a bucket's place and number of queries, on chip.
const BUCKET_BYTES: u64 = 8;

/// Queries wait in buckets until one has no room for the next. Then they leave from the current bucket until there is
/// room; when it is empty, the fullest becomes the current one. So the window is as full as it can be.
pub struct Hashed {
    grid: Grid,
    capacity: usize,
    /// Queries, and whether they are on chip.
    buckets: Vec<VecDeque<(Query, bool)>>,
    current: Option<usize>,
    costs: Costs,
}

impl Hashed {
    /// `buckets` buckets for at most `capacity` queries each.
    #[must_use]
    pub fn new(grid: Grid, buckets: u32, capacity: u32, store: Store) -> Self {
        let mut costs = Costs::new(store);
        costs.tables(u64::from(buckets) * BUCKET_BYTES);
        Self {
            grid,
            capacity: capacity.max(1) as usize,
            buckets: vec![VecDeque::new(); buckets.max(1) as usize],
            current: None,
            costs,
        }
    }

    /// One query leaves, if there is one: from the current bucket, or from the fullest if that is empty.
    fn pop(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<bool> {
        let current = self.current.filter(|&current| !self.buckets[current].is_empty()).unwrap_or_else(|| {
            // Of equally full ones the first.
            let fullest = (0..self.buckets.len()).rev().max_by_key(|&bucket| self.buckets[bucket].len());
            fullest.expect("there is a bucket")
        });
        self.current = Some(current);
        let Some((query, on_chip)) = self.buckets[current].pop_front() else { return Ok(false) };
        self.costs.release(on_chip);
        out.leave(query)?;
        Ok(true)
    }
}

/// The bucket of a cell.
fn bucket([x, y, z]: [u32; 3], buckets: usize) -> usize {
    let hash = x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ z.wrapping_mul(83_492_791);
    hash as usize % buckets
}

impl Reorder for Hashed {
    fn push(&mut self, queries: &[Query], out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        for &query in queries {
            let bucket = bucket(self.grid.cell(query.position), self.buckets.len());
            while self.buckets[bucket].len() == self.capacity {
                self.pop(out)?;
            }
            let on_chip = self.costs.admit();
            self.buckets[bucket].push_back((query, on_chip));
        }
        Ok(())
    }

    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        while self.pop(out)? {}
        Ok(())
    }

    fn measures(&self) -> Vec<(String, Number)> {
        self.costs.measures()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Per, Record, Reordering};
    use bytemuck::Zeroable as _;
    use pm_formats::{BlockMeta, Bounds};

    /// Four cells in a row, which the hash puts into four of eight buckets.
    fn order(capacity: u32) -> Reordering {
        let grid = Grid::across(&Bounds { min: [0.0; 3], max: [4.0, 1.0, 1.0] }, 4);
        let of = |x: u32| bucket([x, 0, 0], 8);
        assert!((0..4).all(|x| (0..x).all(|y| of(x) != of(y))));
        let store = Store { bytes: 1 << 20, record: Record::Full };
        Reordering::new(Per::Image, Box::new(Hashed::new(grid, 8, capacity, store)))
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
}
