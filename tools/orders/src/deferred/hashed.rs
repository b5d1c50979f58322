//! The paper's hashed order: a window of queries, sorted into buckets by the cell of the scene that they lie in.
//!
//! Steinhurst, Coombe, Lastra, GI 2005, section 3.2. The paper does not state its hash; this is that of Teschner,
//! Heidelberger, Müller, Pomeranets, Gross, *Optimized Spatial Hashing for Collision Detection of Deformable Objects*,
//! VMV 2003.

use super::parameters::CELL;
use crate::{Costs, Order, Outlet, Reorder, Setting, Store};
use pm_curves::Grid;
use pm_formats::Query;
use pm_registry::{Domain, Parameter, ParameterError, Values};
use std::collections::VecDeque;

/// Bytes of a bucket's address and number of queries, on chip.
const BUCKET_BYTES: u64 = 8;
/// Cells along the scene's longest side, unless their size is said: of 4, 8, 16 and 32 the ones that serve direction binning best;
/// with 32 the few buckets mix what lies far apart, and more is fetched than without a hash.
const CELLS: u32 = 8;
/// Cells beyond that number along a side are smaller than what coordinates tell apart.
const MOST_CELLS: u32 = 1 << 24;

const BUCKETS: Parameter = Parameter::new("buckets", Domain::count(1, 1 << 20), "number of buckets").or("37");
const CAPACITY: Parameter =
    Parameter::new("capacity", Domain::count(1, 1 << 20), "queries that a bucket holds").or("128");
const SIDE: Parameter =
    Parameter { help: "side of its cells, in scene units [default: 1/8 of the scene's longest side]", ..CELL };

pm_registry::registered! {
    /// Through hash buckets of cells: when one is full, the current one is emptied, then the fullest; streaming
    pub struct Hashed = "hashed" with [BUCKETS, CAPACITY, SIDE];
}

impl Order for Hashed {
    fn label(&self, values: &Values, _: Store) -> String {
        format!("hashed {}x{}", values.count::<u32>(BUCKETS.name), values.count::<u32>(CAPACITY.name))
    }

    fn is_streaming(&self) -> bool {
        true
    }

    fn forms(&self) -> &'static [&'static str] {
        &["", "--buckets 7 --capacity 16", "--buckets 1 --capacity 1", "--cell 0.03125"]
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        let (values, bounds) = (setting.values, setting.bounds);
        let grid = values.length_if_any(CELL.name).map(|side| Grid::of_side(&bounds, side, MOST_CELLS));
        let grid = grid.unwrap_or_else(|| Grid::across(&bounds, CELLS));
        let (buckets, capacity) = (values.count(BUCKETS.name), values.count(CAPACITY.name));
        Ok(Box::new(HashBuckets::new(grid, buckets, capacity, setting.store)))
    }
}

/// Queries wait in buckets until one has no room for the next. Then they leave from the current bucket until there is
/// room; when it is empty, the fullest becomes the current one. So the window is as full as it can be.
struct HashBuckets {
    grid: Grid,
    capacity: usize,
    /// Queries, and whether they are on chip.
    buckets: Vec<VecDeque<(Query, bool)>>,
    current: Option<usize>,
    costs: Costs,
}

impl HashBuckets {
    /// `buckets` buckets for at most `capacity` queries each.
    fn new(grid: Grid, buckets: u32, capacity: u32, store: Store) -> Self {
        let mut costs = Costs::new(store);
        costs.set_tables(u64::from(buckets) * BUCKET_BYTES);
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

impl Reorder for HashBuckets {
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

    fn costs(&self) -> &Costs {
        &self.costs
    }
}

#[cfg(test)]
mod tests;
