//! A brick map: an octree each of whose nodes has a brick of 8 x 8 x 8 voxels.
//!
//! Christensen and Batali, *An Irradiance Atlas for Global Illumination in Complex Production Scenes*, Eurographics Symposium
//! on Rendering 2004: irradiance in a hierarchy of bricks, of which a lookup takes the level that its ray's footprint asks for.
//! A brick is 8 KiB, as large as a line of the cache of bricks that such a map is made for (`pm-cachesim --lines 8192`). A node
//! has a child where more samples lie than a wall has voxels in a brick, so that finer voxels hold about one or more.

use super::Sample;
use super::cells::{CellMap, Place};
use super::grid::{Cube, FINEST, above};
use super::voxel::{Cell, Voxel};
use pm_curves::morton_key;
use pm_formats::Number;
use pm_formats::trace::Coding;
use pm_maps::{AccessObserver as _, SearchReads};
use std::collections::VecDeque;

/// Halvings of a node's cube that lead to its voxels.
const VOXEL_BITS: u32 = 3;
/// Voxels of a brick.
const VOXELS: u32 = 1 << (3 * VOXEL_BITS);
/// A child is made for more samples than this: the voxels of a brick that a wall goes through.
const WALL: usize = 1 << (2 * VOXEL_BITS);
/// Depth of the deepest nodes, below the root.
const DEEPEST: u32 = FINEST - VOXEL_BITS;

/// A node: 8 bytes. Its brick has its number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
struct Node {
    /// Number of the first child.
    first: u32,
    /// Which of the eight children there are.
    mask: u32,
}

const _: () = assert!(size_of::<Node>() == 8);

impl Node {
    /// Number of the child in an octant.
    const fn child(self, octant: u32) -> Option<u32> {
        if self.mask >> octant & 1 == 0 {
            return None;
        }
        Some(self.first + (self.mask & ((1 << octant) - 1)).count_ones())
    }
}

/// The octree and its bricks.
pub(super) struct BrickMap {
    cube: Cube,
    /// Breadth first, the children of a node side by side.
    nodes: Vec<Node>,
    /// Of all bricks, along Morton's curve in each, so that a line of memory is a small cube.
    voxels: Vec<Voxel>,
    levels: u32,
}

/// A node to be made: its depth and its samples.
struct Coming<'a> {
    depth: u32,
    samples: Vec<([u32; 3], &'a Sample)>,
}

impl BrickMap {
    /// Holds these samples.
    pub(super) fn build(samples: &[Sample]) -> Self {
        let cube = Cube::around(samples);
        let all = samples.iter().map(|sample| (cube.finest(sample.position), sample)).collect();
        let mut coming = VecDeque::from([Coming { depth: 0, samples: all }]);
        let mut map = Self { cube, nodes: vec![], voxels: vec![], levels: 0 };
        let mut made = 1;
        while let Some(node) = coming.pop_front() {
            map.add_brick(&node);
            map.levels = node.depth + 1;
            let mut own = Node { first: made, mask: 0 };
            if node.depth < DEEPEST {
                let mut octants: [Vec<_>; 8] = Default::default();
                for (finest, sample) in node.samples {
                    octants[octant(finest, node.depth) as usize].push((finest, sample));
                }
                for (at, samples) in octants.into_iter().enumerate().filter(|(_, samples)| samples.len() > WALL) {
                    own.mask |= 1 << at;
                    made += 1;
                    coming.push_back(Coming { depth: node.depth + 1, samples });
                }
            }
            map.nodes.push(own);
        }
        map
    }

    /// Adds the brick of a node.
    fn add_brick(&mut self, node: &Coming<'_>) {
        let mut voxels: Vec<Vec<&Sample>> = vec![vec![]; VOXELS as usize];
        let mut cells = vec![[0; 3]; VOXELS as usize];
        for &(finest, sample) in &node.samples {
            let cell = above(finest, node.depth + VOXEL_BITS);
            let at = in_brick(cell) as usize;
            voxels[at].push(sample);
            cells[at] = cell;
        }
        for (samples, cell) in voxels.iter().zip(cells) {
            let name = self.voxels.len() as u64;
            self.voxels.push(Voxel::of(samples, self.cell(cell, node.depth), name));
        }
    }

    /// The cube of a voxel of a node at this depth.
    fn cell(&self, voxel: [u32; 3], depth: u32) -> Cell {
        let halvings = depth + VOXEL_BITS;
        Cell { centre: self.cube.centre(voxel, halvings), width: self.cube.width(halvings) }
    }
}

/// Which child of a node at this depth holds a finest cell.
fn octant(finest: [u32; 3], depth: u32) -> u32 {
    morton_key(above(finest, depth + 1).map(|x| x & 1))
}

/// Number of a voxel in its brick.
fn in_brick(voxel: [u32; 3]) -> u32 {
    morton_key(voxel.map(|x| x & ((1 << VOXEL_BITS) - 1)))
}

impl CellMap for BrickMap {
    fn regions(&self) -> Vec<(String, u64, u32, Coding)> {
        let bytes = |records: usize, size: usize| (records * size) as u64;
        vec![
            (
                "brick nodes".into(),
                bytes(self.nodes.len(), size_of::<Node>()),
                size_of::<Node>() as u32,
                Coding::InTurns,
            ),
            ("bricks".into(), bytes(self.voxels.len(), size_of::<Voxel>()), size_of::<Voxel>() as u32, Coding::InTurns),
        ]
    }

    /// Reads the nodes down to the level wanted, a voxel there, and those of other levels while none knows of the surface.
    fn find(&self, place: &Place, first: u16, reads: &mut SearchReads) -> Option<[f64; 3]> {
        let finest = self.cube.finest(place.point);
        let mut way = [0u32; DEEPEST as usize + 1];
        let mut depth = 0;
        reads.read(first, 0);
        let look = |node: u32, depth: u32, reads: &mut SearchReads| {
            let voxel = above(finest, depth + VOXEL_BITS);
            let record = node * VOXELS + in_brick(voxel);
            reads.read(first + 1, record);
            self.voxels[record as usize].at(place.point, place.normal, self.cell(voxel, depth))
        };
        let narrow_enough = |depth: u32| self.cube.width(depth + VOXEL_BITS) <= f64::from(place.footprint);
        let mut begun = None;
        loop {
            let node = way[depth as usize];
            let child =
                self.nodes[node as usize].child(octant(finest, depth.min(DEEPEST - 1))).filter(|_| depth < DEEPEST);
            if begun.is_some() || narrow_enough(depth) || child.is_none() {
                begun = begun.or(Some(depth));
                if let Some(irradiance) = look(node, depth, reads) {
                    return Some(irradiance);
                }
            }
            let Some(child) = child else { break };
            depth += 1;
            way[depth as usize] = child;
            reads.read(first, child);
        }
        (0..begun?).rev().find_map(|depth| look(way[depth as usize], depth, reads))
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        let known = self.voxels.iter().filter(|voxel| voxel.is_known()).count();
        vec![
            ("bricks", Number::Count(self.nodes.len() as u64)),
            ("brick_levels", Number::Count(u64::from(self.levels))),
            ("voxels_known", Number::Count(known as u64)),
        ]
    }
}

#[cfg(test)]
mod tests;
