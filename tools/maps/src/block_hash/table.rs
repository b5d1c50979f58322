//! One of the hash tables.

use crate::point::Point;
use std::cmp::Reverse;

/// One hash table: as many buckets as there are cells with photons in them, found at the first probe. A cell without
/// photons shares the bucket of another, which says whose it is.
pub(super) struct Table {
    /// For each axis, ascending.
    pub(super) thresholds: [Vec<f32>; 3],
    /// The cells that have a bucket, ascending.
    pub(super) cells: Vec<u32>,
    /// The bucket of each.
    pub(super) buckets: Vec<Vec<Reference>>,
    /// Number of the first bucket in the traced memory.
    pub(super) first: u32,
}

/// That a block has photons in a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Reference {
    pub(super) block: u32,
    pub(super) photons: u32,
}

impl Table {
    /// The table of these blocks of photons, whose buckets have room for `room` references each.
    pub(super) fn new<'a>(
        thresholds: [Vec<f32>; 3],
        first: u32,
        room: usize,
        blocks: impl Iterator<Item = &'a [Point]>,
    ) -> Self {
        let mut table = Self { thresholds, cells: vec![], buckets: vec![], first };
        let mut pairs: Vec<(u32, u32)> = (0..)
            .zip(blocks)
            .flat_map(|(block, points)| points.iter().map(move |point| (point, block)))
            .map(|(point, block)| (table.cell(point.position), block))
            .collect();
        pairs.sort_unstable();
        for cell in pairs.chunk_by(|a, b| a.0 == b.0) {
            let mut references: Vec<Reference> = cell
                .chunk_by(|a, b| a == b)
                .map(|same| Reference { block: same[0].1, photons: same.len() as u32 })
                .collect();
            // The least priority is dropped, ties by number.
            references.sort_by_key(|reference| (Reverse(reference.photons), reference.block));
            references.truncate(room);
            table.cells.push(cell[0].0);
            table.buckets.push(references);
        }
        table
    }

    /// The references in all buckets.
    pub(super) fn references(&self) -> impl Iterator<Item = &Reference> {
        self.buckets.iter().flatten()
    }

    /// The cell of a position: for each axis the number of thresholds that are not above it.
    pub(super) fn cell(&self, position: [f32; 3]) -> u32 {
        (0..3).fold(0, |cell, axis| {
            let thresholds = &self.thresholds[axis];
            let below = thresholds.partition_point(|&threshold| threshold <= position[axis]);
            cell * (thresholds.len() as u32 + 1) + below as u32
        })
    }

    /// The bucket of a position: which one to read, and whether it is that of the cell.
    pub(super) fn bucket(&self, position: [f32; 3]) -> (usize, bool) {
        let cell = self.cell(position);
        let at = self.cells.partition_point(|&other| other < cell);
        (at.min(self.cells.len().saturating_sub(1)), self.cells.get(at) == Some(&cell))
    }
}
