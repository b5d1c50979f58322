//! Block hashing: photons in blocks of one line, found through hash tables whose cells follow the photons' density.
//! Approximate: a search reads no more than it was allowed to.
//!
//! Ma, McCool, *Low Latency Photon Mapping Using Block Hashing*, Graphics Hardware 2002. What is not known of their
//! heuristics is chosen here: how thresholds follow from the number of photons, and what becomes of orphans.

mod build;
mod table;

use super::photon_blocks::PhotonBlocks;
use super::{AccessObserver, Nearest, PhotonMap};
use pm_formats::Number;
use pm_formats::trace::{Coding, Region, Waits, lay_out};
use table::{Reference, Table};

/// Number of the region that holds the buckets.
const BUCKETS: u16 = 0;
pm_registry::choices! {
    /// What becomes of blocks that no bucket has room for.
    #[derive(Debug, Default)]
    pub enum Orphans {
        /// They are never found, as in GI'05
        #[default]
        Keep = "keep",
        /// Each takes the place of a reference that another bucket holds as well
        Repair = "repair",
    }
}

/// How the tables are made and searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockHashOptions {
    /// Bytes of a block and of a bucket.
    pub line: u32,
    /// Number of tables, L; `None` for the natural logarithm of the number of photons, 4 to 16.
    pub tables: Option<u32>,
    /// Thresholds along each axis, P; `None` for as many as let the photons of a cell on a wall fill about half a bucket.
    pub thresholds: Option<u32>,
    /// References in a bucket; `None` for as many as a line has room for.
    pub slots: Option<u32>,
    /// Photons read by a search for each that is wanted, A.
    pub budget: u32,
    /// What becomes of blocks that no bucket has room for.
    pub orphans: Orphans,
    /// Seed of the thresholds.
    pub seed: u64,
}

/// The tables.
pub struct BlockHash {
    blocks: PhotonBlocks,
    tables: Vec<Table>,
    budget: u32,
    line: u32,
    photons: usize,
    unreferenced: usize,
}

impl BlockHash {
    /// Number of the region that holds the photons.
    pub const BLOCKS: u16 = 1;

    /// Buckets of all tables.
    #[must_use]
    pub fn buckets(&self) -> usize {
        self.tables.iter().map(|table| table.buckets.len()).sum()
    }

    /// Number of blocks of photons.
    #[must_use]
    pub const fn number_of_blocks(&self) -> usize {
        self.blocks.len()
    }

    /// Blocks that no bucket refers to: no search ever finds their photons.
    #[must_use]
    pub const fn unreferenced(&self) -> usize {
        self.unreferenced
    }

    /// Number of tables, and of thresholds along each axis.
    #[must_use]
    pub fn sizes(&self) -> (usize, usize) {
        (self.tables.len(), self.tables.first().map_or(0, |table| table.thresholds[0].len()))
    }

    /// Photons that a search for `k` may read.
    #[must_use]
    pub const fn photons_allowed(&self, k: usize) -> usize {
        k.saturating_mul(self.budget as usize)
    }

    /// The block of each photon.
    #[must_use]
    pub fn block_of_photons(&self) -> Vec<u32> {
        let mut block_of = vec![0; self.photons];
        for block in 0..self.blocks.len() {
            self.blocks.ids(block).for_each(|id| block_of[id as usize] = block as u32);
        }
        block_of
    }
}

impl PhotonMap for BlockHash {
    fn regions(&self, _: bool) -> Vec<Region> {
        let line = u64::from(self.line);
        lay_out([
            ("hash buckets".into(), self.buckets() as u64 * line, self.line, Coding::InTurns),
            ("photon blocks".into(), self.blocks.len() as u64 * line, self.line, Coding::InTurns),
        ])
    }

    fn len(&self) -> usize {
        self.photons
    }

    fn is_exact(&self) -> bool {
        false
    }

    fn tells_waits(&self) -> bool {
        true
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        let count = |number: usize| Number::Count(number as u64);
        let (tables, thresholds) = self.sizes();
        vec![
            ("tables", count(tables)),
            ("thresholds", count(thresholds)),
            ("buckets", count(self.buckets())),
            ("blocks", count(self.blocks.len())),
            ("blocks_unreferenced", count(self.unreferenced)),
        ]
    }

    fn blocks(&self) -> Option<(u16, Vec<u32>)> {
        Some((Self::BLOCKS, self.block_of_photons()))
    }

    /// Reads the query's bucket of each table, full or empty, and then the blocks they refer to, those first that have
    /// most photons in these cells, until as many photons are read as are allowed.
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        if self.photons == 0 {
            return;
        }
        let mut wanted: Vec<Reference> = vec![];
        for table in &self.tables {
            let (bucket, is_there) = table.bucket(point);
            eyes.read_after(BUCKETS, table.first + bucket as u32, Waits::NOTHING);
            if is_there {
                wanted.extend_from_slice(&table.buckets[bucket]);
            }
        }
        wanted.sort_unstable_by_key(|reference| reference.block);
        wanted.dedup_by(|again, first| {
            let same = again.block == first.block;
            if same {
                first.photons += again.photons;
            }
            same
        });
        wanted.sort_unstable_by_key(|reference| (std::cmp::Reverse(reference.photons), reference.block));
        let (mut seen, allowed) = (0, self.photons_allowed(found.k()));
        for reference in wanted {
            if seen >= allowed {
                break;
            }
            // Which blocks come first all buckets say together.
            eyes.read_after(Self::BLOCKS, reference.block, Waits::all_above(1));
            let block = reference.block as usize;
            seen += self.blocks.count(block);
            eyes.examined(self.blocks.count(block));
            self.blocks.show(block, point, found);
        }
    }
}

#[cfg(test)]
mod tests;
