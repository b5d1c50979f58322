//! A cache of hashed cells: irradiance by place, facing and width in one hash table.
//!
//! Cells of quantised position and normal, as wide as the footprint of the ray that asks, looked up by a hash: Binder, Fricke
//! and Keller's path space filtering, and the radiance caches of today's real-time renderers. They fill theirs while they
//! render; this one is filled beforehand from the same samples as the other structures, and then asked once at the end of each
//! gather ray. An entry is its key, 8 bytes, and a voxel, 16 more. The table is at most half full; an entry whose place is taken
//! goes into the next that is free.

use super::Sample;
use super::cells::{CellMap, Place};
use super::grid::{Cube, FINEST, above};
use super::voxel::{Cell, Voxel, longest};
use pm_formats::trace::Coding;
use pm_formats::{Number, pack_direction, unpack_direction};
use pm_maps::{AccessObserver as _, SearchReads};
use pm_random::mix;

/// No cell: the level of a real key is less.
const EMPTY: u64 = u64::MAX;

/// An entry of the table: 24 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
struct Entry {
    key: u64,
    voxel: Voxel,
}

const _: () = assert!(size_of::<Entry>() == 24);

/// The table.
pub(super) struct CellCache {
    cube: Cube,
    table: Vec<Entry>,
    /// Halvings of the cube that lead to the narrowest cells.
    finest: u32,
    cells: usize,
}

/// Which way a surface faces: the axis along which its normal, as photons hold it, is longest, and to which side.
fn facing(normal: [f32; 3]) -> u64 {
    let normal = unpack_direction::<7>(pack_direction::<7>(normal));
    let longest = longest(normal);
    2 * longest as u64 + u64::from(normal[longest] < 0.0)
}

/// The key of a cell after so many halvings.
fn key([x, y, z]: [u32; 3], halvings: u32, facing: u64) -> u64 {
    let cell = u64::from(x) | u64::from(y) << FINEST | u64::from(z) << (2 * FINEST);
    u64::from(halvings) << 48 | facing << 45 | cell
}

impl CellCache {
    /// Holds these samples, in cells of all widths down to that at which each would hold two or fewer.
    pub(super) fn build(samples: &[Sample]) -> Self {
        let cube = Cube::around(samples);
        let (mut filled, mut finest) = (vec![], 0);
        for halvings in 0..=FINEST {
            let mut level: Vec<(u64, &Sample)> = samples
                .iter()
                .map(|sample| {
                    (key(above(cube.finest(sample.position), halvings), halvings, facing(sample.normal)), sample)
                })
                .collect();
            // Stable: samples of a cell stay in their order.
            level.sort_by_key(|&(key, _)| key);
            let cells: Vec<_> = level.chunk_by(|a, b| a.0 == b.0).collect();
            if halvings > 0 && cells.len() * 2 >= samples.len() {
                break;
            }
            finest = halvings;
            filled.extend(cells.into_iter().map(|cell| {
                let (key, first) = cell[0];
                let samples: Vec<_> = cell.iter().map(|&(_, sample)| sample).collect();
                let cube = Self::cell(&cube, cube.finest(first.position), halvings);
                Entry { key, voxel: Voxel::of(&samples, cube, key) }
            }));
        }
        let cells = filled.len();
        let mut table = vec![Entry { key: EMPTY, voxel: Voxel::default() }; (2 * cells).next_power_of_two().max(2)];
        for entry in filled {
            let free = Self::probes(table.len(), entry.key).find(|&at| table[at].key == EMPTY);
            table[free.expect("half of the table is empty")] = entry;
        }
        Self { cube, table, finest, cells }
    }

    /// Where an entry may be, in a table of so many.
    fn probes(entries: usize, key: u64) -> impl Iterator<Item = usize> {
        #[expect(clippy::cast_possible_truncation, reason = "the lower bits of a hash")]
        let first = mix(key) as usize;
        (0..entries).map(move |step| (first.wrapping_add(step)) & (entries - 1))
    }

    /// The cube that holds a finest cell after so many halvings.
    fn cell(cube: &Cube, finest: [u32; 3], halvings: u32) -> Cell {
        Cell { centre: cube.centre(above(finest, halvings), halvings), width: cube.width(halvings) }
    }

    /// Halvings that lead to the widest cells that are not wider than this.
    fn level(&self, footprint: f32) -> u32 {
        (0..self.finest).find(|&halvings| self.cube.width(halvings) <= f64::from(footprint)).unwrap_or(self.finest)
    }
}

impl CellMap for CellCache {
    fn regions(&self) -> Vec<(String, u64, u32, Coding)> {
        vec![("cells".into(), size_of_val(&self.table[..]) as u64, size_of::<Entry>() as u32, Coding::InTurns)]
    }

    /// Reads entries from where the hash says until the cell's or an empty one; of other levels while none knows of the surface.
    fn find(&self, place: &Place, first: u16, reads: &mut SearchReads) -> Option<[f64; 3]> {
        let (finest, facing, wanted) =
            (self.cube.finest(place.point), facing(place.normal), self.level(place.footprint));
        (wanted..=self.finest).chain((0..wanted).rev()).find_map(|halvings| {
            let key = key(above(finest, halvings), halvings, facing);
            let mut probes = Self::probes(self.table.len(), key);
            let found = probes.find(|&at| {
                reads.read(first, at as u32);
                self.table[at].key == key || self.table[at].key == EMPTY
            });
            let cell = Self::cell(&self.cube, finest, halvings);
            // An empty entry knows nothing.
            found.and_then(|at| self.table[at].voxel.at(place.point, place.normal, cell))
        })
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        let known = self.table.iter().filter(|entry| entry.voxel.is_known()).count();
        vec![
            ("cells", Number::Count(self.cells as u64)),
            ("cell_levels", Number::Count(u64::from(self.finest) + 1)),
            ("cells_known", Number::Count(known as u64)),
        ]
    }
}

#[cfg(test)]
mod tests;
