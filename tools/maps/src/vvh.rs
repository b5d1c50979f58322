//! A kd-tree split where the voxel volume heuristic expects the least work.
//!
//! Wald, Günther, Slusallek, *Balancing Considered Harmful*, Computer Graphics Forum 23(3), 2004: the chance that a
//! query ball meets a voxel grows with the volume of the voxel widened by the ball's radius; the work there, with its
//! photons. Photons lie on surfaces, so that many voxels are flat and have no volume of their own: only the widened one
//! tells splits of a wall apart.

mod heuristic;

use super::chosen_ids::chosen_ids;
use super::error::check;
use super::geometry::{Box3, distance_squared, extent, longest_axis};
use super::point::Point;
use super::select_nth::select_nth;
use super::split_tree::{self, Node, SplitTree};
use super::{AccessObserver, Blind, BucketKdTree, BuildError, Layout, Nearest, PhotonMap, Search};
use heuristic::best_split;
use pm_formats::trace::{Coding, Region, Waits, lay_out};
use pm_formats::{Number, Photon};

/// Number of the region that holds the nodes.
const NODES: u16 = 0;
/// Number of the region that holds the photons.
const PHOTONS: u16 = 1;

/// Bytes of a node in the traced memory: a plane with its axis and the right child, or the photons of a leaf.
const NODE_BYTES: u32 = 8;
/// Deepest tree: twice the levels of a balanced one, then a balanced one of what is left.
const MAX_DEPTH: usize = 128;

/// Photons at which the radius of a query is looked up.
const RADIUS_SAMPLES: usize = 200;

/// The tree, depth first: a node's left child comes after it.
pub struct VvhTree {
    nodes: Vec<Stored>,
    /// How many nodes lie above each.
    levels: Vec<u8>,
    points: Vec<Point>,
    radius: f64,
}

#[derive(Clone, Copy)]
enum Stored {
    Split { axis: u8, plane: f32, right: u32 },
    Leaf { first: u32, count: u32 },
}

impl VvhTree {
    /// Builds the tree in O(n log n) for searches of `k` photons; leaves hold at most as many as a line does.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon], k: usize, line: u32) -> Result<Self, BuildError> {
        check(photons)?;
        BuildError::unless_fits(line, size_of::<Photon>() as u32)?;
        let capacity = line as usize / size_of::<Photon>();
        let radius = typical_radius(photons, k)?;
        let mut points = Point::all(photons);
        let mut tree = Self { nodes: vec![], levels: vec![], points: vec![], radius };
        if !points.is_empty() {
            let cell = extent(points.iter().map(|point| point.position));
            // Beyond this depth splits are medians, or one set of photons could be peeled one by one, in quadratic time.
            let depth = 2 * (points.len() / capacity + 1).ilog2() + 8;
            tree.divide(&mut points, cell, capacity, depth, 0);
        }
        tree.points = points;
        tree.levels = tree.find_levels();
        Ok(tree)
    }

    /// The radius that splits were chosen for, in scene units.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// How many nodes lie above each.
    fn find_levels(&self) -> Vec<u8> {
        let mut levels = vec![0; self.nodes.len()];
        // A node's children come after it.
        for (at, node) in self.nodes.iter().enumerate() {
            if let Stored::Split { right, .. } = *node {
                levels[at + 1] = levels[at] + 1;
                levels[right as usize] = levels[at] + 1;
            }
        }
        levels
    }

    /// Nodes above one. Where nobody asks, nothing is looked up: there is nothing in it that could fail.
    #[inline(always)]
    fn level(&self, at: u32) -> u16 {
        self.levels.get(at as usize).map_or(0, |&level| level.into())
    }

    fn divide(&mut self, points: &mut [Point], cell: Box3, capacity: usize, depth: u32, first: usize) {
        if points.len() <= capacity {
            self.nodes.push(Stored::Leaf { first: first as u32, count: points.len() as u32 });
            return;
        }
        let best = if depth == 0 { None } else { best_split(points, &cell, self.radius) };
        let (axis, middle, plane) = best.unwrap_or_else(|| median(points));
        let at = self.nodes.len();
        self.nodes.push(Stored::Leaf { first: 0, count: 0 });
        let (mut left_cell, mut right_cell) = (cell, cell);
        left_cell.1[axis] = plane;
        right_cell.0[axis] = plane;
        let (left, right) = points.split_at_mut(middle);
        self.divide(left, left_cell, capacity, depth.saturating_sub(1), first);
        self.nodes[at] = Stored::Split { axis: axis as u8, plane, right: self.nodes.len() as u32 };
        self.divide(right, right_cell, capacity, depth.saturating_sub(1), first + middle);
    }
}

/// The median of the k-th neighbours' distances at some photons, chosen by a hash of their ids.
fn typical_radius(photons: &[Photon], k: usize) -> Result<f64, BuildError> {
    let map = BucketKdTree::build(photons, Layout::Heap, 320)?;
    // A photon is its own nearest one.
    let k = k + 1;
    let mut found = Nearest::new(k, f32::INFINITY);
    let mut radii: Vec<f32> = chosen_ids(photons, RADIUS_SAMPLES)
        .into_iter()
        .map(|id| {
            Search::new(k, f32::INFINITY).run(&map, photons[id as usize].position, &mut found, &mut Blind);
            found.farthest().map_or(0.0, |(distance, _)| distance.sqrt())
        })
        .collect();
    radii.sort_by(f32::total_cmp);
    Ok(radii.get(radii.len() / 2).map_or(0.0, |&radius| f64::from(radius)))
}

/// The median along the longest side.
fn median(points: &mut [Point]) -> (usize, usize, f32) {
    let axis = longest_axis(&extent(points.iter().map(|point| point.position)));
    let middle = points.len() / 2;
    select_nth(points, middle, axis);
    (axis, middle, points[middle].position[axis])
}

impl SplitTree for VvhTree {
    #[inline(always)]
    fn node(&self, at: u32, eyes: &mut impl AccessObserver) -> Node {
        eyes.read_after(NODES, at, Waits::last_above(self.level(at)));
        match self.nodes[at as usize] {
            Stored::Split { axis, plane, right } => {
                Node::Split { axis: usize::from(axis), low: plane, high: plane, left: at + 1, right }
            }
            Stored::Leaf { .. } => Node::Leaf(at),
        }
    }

    #[inline(always)]
    fn leaf(&self, leaf: u32, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        let Stored::Leaf { first, count } = self.nodes[leaf as usize] else { return };
        eyes.examined(count as usize);
        for record in first..first + count {
            // The leaf says where its photons are, all of them.
            eyes.read_after(PHOTONS, record, Waits::last_above(self.level(leaf) + 1));
            let stored = self.points[record as usize];
            found.show(distance_squared(point, stored.position), stored.id);
        }
    }
}

impl PhotonMap for VvhTree {
    fn regions(&self, _: bool) -> Vec<Region> {
        let photon = size_of::<Photon>() as u32;
        let bytes = |count: usize, record: u32| count as u64 * u64::from(record);
        lay_out([
            ("vvh nodes".into(), bytes(self.nodes.len(), NODE_BYTES), NODE_BYTES, Coding::InTurns),
            ("photons".into(), bytes(self.points.len(), photon), photon, Coding::InTurns),
        ])
    }

    fn len(&self) -> usize {
        self.points.len()
    }

    fn tells_waits(&self) -> bool {
        true
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        vec![("split_radius", Number::Real(self.radius))]
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        if !self.nodes.is_empty() {
            split_tree::search::<MAX_DEPTH>(self, 0, point, found, eyes);
        }
    }
}

#[cfg(test)]
mod tests;
