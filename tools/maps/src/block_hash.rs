//! Block hashing: photons in blocks of one line, found through hash tables whose cells follow the photons' density.
//! Approximate: a search reads no more than it was allowed to.
//!
//! Ma, McCool, *Low Latency Photon Mapping Using Block Hashing*, Graphics Hardware 2002. What is not known of their
//! heuristics is chosen here: how thresholds follow from the number of photons, and what becomes of orphans.

use super::leaves::{Leaves, Point};
use super::{AccessObserver, BuildError, Nearest, PhotonMap, check, extent};
use pm_curves::fine_hilbert_key;
use pm_formats::trace::{Coding, Region, lay_out};
use pm_formats::{Bounds, Photon};
use pm_random::Random;

/// Number of the region that holds the buckets.
const BUCKETS: u16 = 0;
/// Bytes that a block spends on its number of photons and its own number.
const BLOCK_HEADER: u32 = 8;
/// Bytes that a bucket spends on its cell and its number of references.
const BUCKET_HEADER: u32 = 4;
/// Bytes of a reference: a block's number, and how many of its photons lie in the cell.
const REFERENCE: u32 = 5;

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
    blocks: Leaves,
    tables: Vec<Table>,
    budget: u32,
    line: u32,
    photons: usize,
    unreferenced: usize,
}

/// One hash table: as many buckets as there are cells with photons in them, found at the first probe. A cell without
/// photons shares the bucket of another, which says whose it is.
struct Table {
    /// For each axis, ascending.
    thresholds: [Vec<f32>; 3],
    /// The cells that have a bucket, ascending.
    cells: Vec<u32>,
    /// The bucket of each.
    buckets: Vec<Vec<Reference>>,
    /// Number of the first bucket in the traced memory.
    first: u32,
}

/// That a block has photons in a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Reference {
    block: u32,
    photons: u32,
}

impl Table {
    /// The cell of a position: for each axis the number of thresholds that are not above it.
    fn cell(&self, position: [f32; 3]) -> u32 {
        (0..3).fold(0, |cell, axis| {
            let thresholds = &self.thresholds[axis];
            let below = thresholds.partition_point(|&threshold| threshold <= position[axis]);
            cell * (thresholds.len() as u32 + 1) + below as u32
        })
    }

    /// The bucket of a position: which one to read, and whether it is that of the cell.
    fn bucket(&self, position: [f32; 3]) -> (usize, bool) {
        let cell = self.cell(position);
        let at = self.cells.partition_point(|&other| other < cell);
        (at.min(self.cells.len().saturating_sub(1)), self.cells.get(at) == Some(&cell))
    }
}

impl BlockHash {
    /// Number of the region that holds the photons.
    pub const BLOCKS: u16 = 1;

    /// Builds the tables in O(L n log n).
    ///
    /// # Errors
    /// See [`BuildError`].
    ///
    /// # Panics
    /// If a line has no room for a photon and for a reference.
    pub fn build(photons: &[Photon], options: BlockHashOptions) -> Result<Self, BuildError> {
        check(photons)?;
        let capacity = ((options.line - BLOCK_HEADER) / size_of::<Photon>() as u32) as usize;
        let room = options.slots.unwrap_or((options.line - BUCKET_HEADER) / REFERENCE) as usize;
        assert!(capacity > 0 && room > 0, "a line must hold a photon and a reference");
        let n = photons.len();
        let (tables, thresholds) = sizes(&options, n, room * capacity);
        if u64::from(thresholds + 1).pow(3) > u64::from(u32::MAX) {
            return Err(BuildError::TooLarge);
        }

        let mut points = Point::all(photons);
        let (min, max) = extent(points.iter().map(|point| point.position));
        let bounds = Bounds { min, max };
        points.sort_by_cached_key(|point| (fine_hilbert_key(&bounds, point.position), point.id));
        let mut blocks = Leaves::new(n.div_ceil(capacity), capacity);
        points.chunks(capacity).enumerate().for_each(|(block, points)| blocks.fill(block, points));

        let mut sorted = [0, 1, 2].map(|axis| points.iter().map(|point| point.position[axis]).collect::<Vec<f32>>());
        sorted.iter_mut().for_each(|coordinates| coordinates.sort_unstable_by(f32::total_cmp));
        let mut map =
            Self { blocks, tables: vec![], budget: options.budget, line: options.line, photons: n, unreferenced: 0 };
        // The references that found no room, of the table at hand; who is in some bucket, and in how many.
        let mut held = vec![0u32; map.blocks.len()];
        for table in 0..tables {
            let mut random = Random::new(&[options.seed, u64::from(table)]);
            let thresholds = [0, 1, 2].map(|axis| follow_density(&sorted[axis], thresholds, &mut random));
            let first = map.buckets() as u32;
            let mut table = Table { thresholds, cells: vec![], buckets: vec![], first };
            let mut pairs: Vec<(u32, u32)> = (0..)
                .zip(points.chunks(capacity))
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
                references.sort_by_key(|reference| (std::cmp::Reverse(reference.photons), reference.block));
                references.truncate(room);
                references.iter().for_each(|reference| held[reference.block as usize] += 1);
                table.cells.push(cell[0].0);
                table.buckets.push(references);
            }
            map.tables.push(table);
        }
        if options.orphans == Orphans::Repair {
            map.repair(&points, capacity, &mut held);
        }
        map.unreferenced = held.iter().filter(|&&buckets| buckets == 0).count();
        Ok(map)
    }

    /// Gives each block that is in no bucket the place of a reference that is in another as well: of least priority, in
    /// the bucket of one of its photons. Each is tried once; some may find no such place.
    fn repair(&mut self, points: &[Point], capacity: usize, held: &mut [u32]) {
        for (block, points) in points.chunks(capacity).enumerate() {
            if held[block] > 0 {
                continue;
            }
            let tables = self.tables.len();
            for (table, point) in points.iter().flat_map(|point| (0..tables).map(move |table| (table, point))) {
                let bucket = self.tables[table].bucket(point.position).0;
                let mut references = self.tables[table].buckets[bucket].iter_mut().rev();
                let Some(spare) = references.find(|reference| held[reference.block as usize] > 1) else { continue };
                held[spare.block as usize] -= 1;
                held[block] += 1;
                *spare = Reference { block: block as u32, photons: 1 };
                break;
            }
        }
    }

    /// Buckets of all tables.
    #[must_use]
    pub fn buckets(&self) -> usize {
        self.tables.iter().map(|table| table.buckets.len()).sum()
    }

    /// Blocks of photons.
    #[must_use]
    pub const fn blocks(&self) -> usize {
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

/// Numbers of tables and of thresholds for `n` photons, of which `in_bucket` lie in the blocks that a bucket refers to.
fn sizes(options: &BlockHashOptions, n: usize, in_bucket: usize) -> (u32, u32) {
    let n = n.max(1) as f64;
    let tables = options.tables.unwrap_or_else(|| (libm::log(n).round() as u32).clamp(4, 16));
    // Photons lie on surfaces: of the cells, about as many hold any as two of the three axes have.
    let thresholds = options.thresholds.unwrap_or_else(|| {
        let cells = n / (in_bucket as f64 / 2.0).max(1.0);
        (libm::sqrt(cells).round() as u32).clamp(4, 64)
    });
    (tables, thresholds)
}

/// Thresholds spread as the coordinates are: one in each of as many equal shares of them, anywhere in it.
fn follow_density(sorted: &[f32], count: u32, random: &mut Random) -> Vec<f32> {
    if sorted.is_empty() {
        return vec![0.0; count as usize];
    }
    let share = sorted.len() as f64 / f64::from(count);
    (0..count)
        .map(|i| {
            let at = (f64::from(i) + f64::from(random.unit())) * share;
            sorted[(at as usize).min(sorted.len() - 1)]
        })
        .collect()
}

impl PhotonMap for BlockHash {
    fn regions(&self, _: bool) -> Vec<Region> {
        let line = u64::from(self.line);
        lay_out([
            ("hash buckets".into(), self.buckets() as u64 * line, self.line, Coding::Records),
            ("photon blocks".into(), self.blocks.len() as u64 * line, self.line, Coding::Records),
        ])
    }

    fn len(&self) -> usize {
        self.photons
    }

    fn is_exact(&self) -> bool {
        false
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
            eyes.read(BUCKETS, table.first + bucket as u32);
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
            eyes.read(Self::BLOCKS, reference.block);
            let block = reference.block as usize;
            seen += self.blocks.count(block);
            eyes.examined(self.blocks.count(block));
            self.blocks.show(block, point, found);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Visits;

    const OPTIONS: BlockHashOptions = BlockHashOptions {
        line: 128,
        tables: None,
        thresholds: None,
        slots: None,
        budget: 20,
        orphans: Orphans::Keep,
        seed: 0,
    };

    /// Photons on a wall, evenly.
    fn wall(n: u16) -> Vec<Photon> {
        let mut random = Random::new(&[7]);
        let positions = (0..n).map(|_| [random.unit(), 0.0, random.unit()]);
        positions.map(|p| Photon::new(p, [1.0; 3], [0.5; 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]).unwrap()).collect()
    }

    #[test]
    fn the_budget_is_kept_to_a_block() {
        let photons = wall(20_000);
        for budget in [1, 5, 20] {
            let map = BlockHash::build(&photons, BlockHashOptions { budget, ..OPTIONS }).unwrap();
            let mut found = Nearest::new(10, f32::INFINITY);
            for photon in photons.iter().step_by(997) {
                let mut visits = Visits::default();
                found.restart(f32::INFINITY);
                map.nearest(photon.position, &mut found, &mut visits);
                assert!(visits.photons_examined() < 10 * u64::from(budget) + 6);
                let buckets = visits.runs().filter(|run| run.0 == BUCKETS).map(|run| run.1.len()).sum::<usize>();
                assert_eq!(buckets, map.sizes().0, "one bucket a table");
            }
        }
    }

    #[test]
    fn orphans_are_kept_or_repaired() {
        // One reference a bucket and few cells: most blocks find no room.
        let photons = wall(5000);
        let narrow = BlockHashOptions { slots: Some(1), tables: Some(4), thresholds: Some(4), ..OPTIONS };
        let kept = BlockHash::build(&photons, narrow).unwrap();
        assert!(kept.unreferenced() > kept.blocks() / 2, "{} of {}", kept.unreferenced(), kept.blocks());
        let repaired = BlockHash::build(&photons, BlockHashOptions { orphans: Orphans::Repair, ..narrow }).unwrap();
        assert!(repaired.unreferenced() <= kept.unreferenced());
        // Where there is room, all are referred to, and more so when repaired.
        let tight = BlockHashOptions { slots: Some(4), tables: Some(6), thresholds: Some(10), ..OPTIONS };
        let kept = BlockHash::build(&photons, tight).unwrap();
        let repaired = BlockHash::build(&photons, BlockHashOptions { orphans: Orphans::Repair, ..tight }).unwrap();
        assert!(
            kept.unreferenced() > 0 && repaired.unreferenced() == 0,
            "{} {}",
            kept.unreferenced(),
            repaired.unreferenced()
        );
    }

    #[test]
    fn what_no_bucket_refers_to_is_counted_by_looking() {
        let photons = wall(3000);
        for orphans in [Orphans::Keep, Orphans::Repair] {
            for (slots, tables, thresholds) in [(3, 8, 8), (1, 4, 4), (2, 6, 10)] {
                let sizes = BlockHashOptions { tables: Some(tables), thresholds: Some(thresholds), ..OPTIONS };
                let map =
                    BlockHash::build(&photons, BlockHashOptions { slots: Some(slots), orphans, ..sizes }).unwrap();
                let buckets = || map.tables.iter().flat_map(|table| &table.buckets);
                let referenced: std::collections::BTreeSet<u32> =
                    buckets().flatten().map(|reference| reference.block).collect();
                assert_eq!(map.blocks() - referenced.len(), map.unreferenced(), "{orphans:?} {slots}");
                assert!(buckets().all(|bucket| bucket.len() <= slots as usize));
            }
        }
    }

    #[test]
    fn thresholds_follow_the_photons() {
        // Nine tenths of the coordinates lie below 0.1.
        let sorted: Vec<f32> = (0..1000u16)
            .map(|i| if i < 900 { f32::from(i) / 9000.0 } else { 0.1 + f32::from(i - 900) * 0.009 })
            .collect();
        let thresholds = follow_density(&sorted, 20, &mut Random::new(&[1]));
        assert!(thresholds.is_sorted());
        let below = thresholds.iter().filter(|&&threshold| threshold < 0.1).count();
        assert_eq!(below, 18);
    }
}
