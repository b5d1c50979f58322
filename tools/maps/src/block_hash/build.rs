//! Making the tables: thresholds that follow the photons' density, references by priority, orphans.

use super::{BlockHash, BlockHashOptions, Orphans, Reference, Table};
use crate::BuildError;
use crate::error::check;
use crate::geometry::extent;
use crate::photon_blocks::PhotonBlocks;
use crate::point::Point;
use pm_curves::fine_hilbert_key;
use pm_formats::{Bounds, Photon};
use pm_random::Random;

/// Bytes that a block spends on its number of photons and its own number.
const BLOCK_HEADER: u32 = 8;
/// Bytes that a bucket spends on its cell and its number of references.
const BUCKET_HEADER: u32 = 4;
/// Bytes of a reference: a block's number, and how many of its photons lie in the cell.
const REFERENCE: u32 = 5;

impl BlockHash {
    /// Builds the tables in O(L n log n).
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon], options: BlockHashOptions) -> Result<Self, BuildError> {
        check(photons)?;
        BuildError::unless_fits(options.line, BLOCK_HEADER + size_of::<Photon>() as u32)?;
        let capacity = ((options.line - BLOCK_HEADER) / size_of::<Photon>() as u32) as usize;
        let room = options.slots.unwrap_or((options.line - BUCKET_HEADER) / REFERENCE).max(1) as usize;
        let n = photons.len();
        let (tables, thresholds) = sizes(&options, n, room * capacity);
        if u64::from(thresholds + 1).pow(3) > u64::from(u32::MAX) {
            return Err(BuildError::TooLarge);
        }

        let mut points = Point::all(photons);
        let (min, max) = extent(points.iter().map(|point| point.position));
        let bounds = Bounds { min, max };
        points.sort_by_cached_key(|point| (fine_hilbert_key(&bounds, point.position), point.id));
        let mut blocks = PhotonBlocks::new(n.div_ceil(capacity), capacity);
        points.chunks(capacity).enumerate().for_each(|(block, points)| blocks.fill(block, points));

        let mut sorted = [0, 1, 2].map(|axis| points.iter().map(|point| point.position[axis]).collect::<Vec<f32>>());
        sorted.iter_mut().for_each(|coordinates| coordinates.sort_unstable_by(f32::total_cmp));
        let mut map =
            Self { blocks, tables: vec![], budget: options.budget, line: options.line, photons: n, unreferenced: 0 };
        // In how many buckets each block is.
        let mut held = vec![0u32; map.blocks.len()];
        for table in 0..tables {
            let mut random = Random::new(&[options.seed, u64::from(table)]);
            let thresholds = [0, 1, 2].map(|axis| follow_density(&sorted[axis], thresholds, &mut random));
            let first = map.buckets() as u32;
            let blocks = points.chunks(capacity);
            let table = Table::new(thresholds, first, room, blocks);
            table.references().for_each(|reference| held[reference.block as usize] += 1);
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
pub(super) fn follow_density(sorted: &[f32], count: u32, random: &mut Random) -> Vec<f32> {
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
