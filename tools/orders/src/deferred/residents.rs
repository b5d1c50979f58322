//! Which cells are resident in which cast of a batch: those with most queries a photon first.

use crate::MedianSplit;
use std::cmp::Reverse;

/// Bytes of a cell's photons and its queries in the sample, on chip.
const CELL_BYTES: u64 = 8;

/// The cells, and the casts in which they are resident.
pub(super) struct Residents {
    split: MedianSplit,
    /// Photons of each cell.
    photons: Vec<u64>,
    /// Most photons of the cells that are resident in one cast.
    most: u64,
    casts: u32,
    /// Of each cell: the cast that answers its queries, or those casts and its number.
    ranks: Vec<u32>,
}

impl Residents {
    /// Cells of at most `leaf` photons; for each of so many casts those are resident that hold `most` photons together.
    pub(super) fn new(photons: Vec<[f32; 3]>, leaf: usize, most: u64, casts: u32) -> Self {
        let split = MedianSplit::new(photons.clone(), leaf);
        let mut in_cells = vec![0; split.cells() as usize];
        photons.iter().for_each(|&photon| in_cells[split.cell(photon) as usize] += 1);
        Self { split, photons: in_cells, most, casts, ranks: vec![] }
    }

    /// Bytes of tables on chip.
    pub(super) fn bytes(&self) -> u64 {
        self.split.bytes() + self.photons.len() as u64 * CELL_BYTES
    }

    /// The cell that a point lies in.
    pub(super) fn cell(&self, point: [f32; 3]) -> u32 {
        self.split.cell(point)
    }

    /// Chooses by the cells of the queries in a sample. Returns the number of casts that this takes, and of cells that are
    /// resident in none of them.
    pub(super) fn choose(&mut self, sample: &[u32]) -> (u32, u64) {
        let mut sampled = vec![0u64; self.photons.len()];
        sample.iter().for_each(|&cell| sampled[cell as usize] += 1);
        let mut best: Vec<usize> = (0..self.photons.len()).collect();
        // By queries a photon, as whole numbers of 2^-32; equal ones as they are numbered.
        best.sort_by_key(|&cell| Reverse((sampled[cell] << 32) / self.photons[cell].max(1)));
        self.ranks = (0..).take(self.photons.len()).map(|cell| self.casts + cell).collect();
        let (mut cast, mut room, mut without) = (0, self.most, self.photons.len() as u64);
        for cell in best {
            let photons = self.photons[cell];
            if photons > room && photons <= self.most && cast + 1 < self.casts {
                (cast, room) = (cast + 1, self.most);
            }
            if photons <= room {
                self.ranks[cell] = cast;
                room -= photons;
                without -= 1;
            }
        }
        // What is resident in no cast waits in the last.
        (if without == 0 { cast + 1 } else { self.casts }, without)
    }

    /// When queries at a point leave: in the order of these numbers.
    pub(super) fn rank(&self, point: [f32; 3]) -> u32 {
        self.ranks[self.cell(point) as usize]
    }

    /// Are queries of this rank answered as they are cast?
    pub(super) const fn at_once(&self, rank: u32) -> bool {
        rank < self.casts
    }
}
