//! A kd-tree split where the voxel volume heuristic expects the least work.
//!
//! Wald, Günther, Slusallek, *Balancing Considered Harmful*, Computer Graphics Forum 23(3), 2004: the chance that a
//! query ball meets a voxel grows with the volume of the voxel widened by the ball's radius; the work there, with its
//! photons. Photons lie on surfaces, so that many voxels are flat and have no volume of their own: only the widened one
//! tells splits of a wall apart.

use super::leaves::Point;
use super::split_tree::{self, Node, SplitTree};
use super::{AccessObserver, BuildError, Layout, Nearest, PhotonMap, check, distance_squared, extent};
use super::{Blind, Box3, BucketKdTree, Search, chosen_ids, longest_axis};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};
use std::f64::consts::PI;

/// Number of the region that holds the nodes.
const NODES: u16 = 0;
/// Number of the region that holds the photons.
const PHOTONS: u16 = 1;

/// Bytes of a node in the traced memory: a plane with its axis and the right child, or the photons of a leaf.
const NODE_BYTES: u32 = 8;
/// Deepest tree: twice the levels of a balanced one, then a balanced one of what is left.
const MAX_DEPTH: usize = 128;

/// Sets of more photons than this are split at the rims of [`BINS`] bins a side, smaller ones at any photon.
const FEW: usize = 256;
const BINS: usize = 64;
/// Photons at which the radius of a query is looked up.
const RADIUS_SAMPLES: usize = 200;

/// The tree, depth first: a node's left child comes after it.
pub struct VvhTree {
    nodes: Vec<Stored>,
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
    ///
    /// # Panics
    /// If a line has no room for a photon.
    pub fn build(photons: &[Photon], k: usize, line: u32) -> Result<Self, BuildError> {
        check(photons)?;
        let capacity = line as usize / size_of::<Photon>();
        assert!(capacity > 0, "a photon must fit a line");
        let radius = typical_radius(photons, k)?;
        let mut points = Point::all(photons);
        let mut tree = Self { nodes: vec![], points: vec![], radius };
        if !points.is_empty() {
            let cell = extent(points.iter().map(|point| point.position));
            // Beyond this depth splits are medians, or one set of photons could be peeled one by one, in quadratic time.
            let depth = 2 * (points.len() / capacity + 1).ilog2() + 8;
            tree.divide(&mut points, cell, capacity, depth, 0);
        }
        tree.points = points;
        Ok(tree)
    }

    /// The radius that splits were chosen for, in scene units.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
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

/// Volume of a box widened by a ball: Steiner's formula for its parallel body.
fn widened_volume(bounds: &Box3, r: f64) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|axis| f64::from(bounds.1[axis]) - f64::from(bounds.0[axis]));
    a * b * c + 2.0 * r * (a * b + b * c + c * a) + PI * r * r * (a + b + c) + 4.0 / 3.0 * PI * r * r * r
}

/// Sorts the photons about the split of least expected work: its axis, number of photons on the left, and plane. `None`
/// if none is better than no split at all.
fn best_split(points: &mut [Point], cell: &Box3, radius: f64) -> Option<(usize, usize, f32)> {
    let mut best = (points.len() as f64 * widened_volume(cell, radius), None);
    let mut consider = |axis: usize, left: usize, low: f32, high: f32| {
        // Empty space goes to the one side or to the other.
        for plane in [low, high] {
            let (mut left_cell, mut right_cell) = (*cell, *cell);
            left_cell.1[axis] = plane;
            right_cell.0[axis] = plane;
            let work = left as f64 * widened_volume(&left_cell, radius)
                + (points.len() - left) as f64 * widened_volume(&right_cell, radius);
            if work < best.0 {
                best = (work, Some((axis, left, plane)));
            }
        }
    };
    let few = points.len() <= FEW;
    let bounds = extent(points.iter().map(|point| point.position));
    for axis in 0..3 {
        if bounds.0[axis] >= bounds.1[axis] {
            continue;
        }
        if few {
            let mut coordinates: Vec<f32> = points.iter().map(|point| point.position[axis]).collect();
            coordinates.sort_unstable_by(f32::total_cmp);
            for (left, pair) in (1..).zip(coordinates.windows(2)) {
                if pair[0] < pair[1] {
                    consider(axis, left, pair[0], pair[1]);
                }
            }
            continue;
        }
        let mut bins = [(0usize, f32::INFINITY, f32::NEG_INFINITY); BINS];
        for point in &*points {
            let x = point.position[axis];
            let bin = &mut bins[bin_of(x, bounds.0[axis], bounds.1[axis])];
            *bin = (bin.0 + 1, bin.1.min(x), bin.2.max(x));
        }
        let (mut left, mut low) = (0, f32::NEG_INFINITY);
        for bin in bins.iter().filter(|bin| bin.0 > 0) {
            if left > 0 {
                consider(axis, left, low, bin.1);
            }
            left += bin.0;
            low = bin.2;
        }
    }
    let (axis, left, plane) = best.1?;
    // The photons left of the split are the `left` first along its axis, by coordinate alone.
    points.select_nth_unstable_by(left, Point::along(axis));
    Some((axis, left, plane))
}

/// Which of the bins between two coordinates; monotone, so that counts are exact.
fn bin_of(x: f32, least: f32, greatest: f32) -> usize {
    let share = (f64::from(x) - f64::from(least)) / (f64::from(greatest) - f64::from(least));
    ((share * BINS as f64) as usize).min(BINS - 1)
}

fn median(points: &mut [Point]) -> (usize, usize, f32) {
    let axis = longest_axis(&extent(points.iter().map(|point| point.position)));
    let middle = points.len() / 2;
    let (_, median, _) = points.select_nth_unstable_by(middle, Point::along(axis));
    (axis, middle, median.position[axis])
}

impl SplitTree for VvhTree {
    #[inline(always)]
    fn node(&self, at: u32, eyes: &mut impl AccessObserver) -> Node {
        eyes.read(NODES, at);
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
            eyes.read(PHOTONS, record);
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
            ("vvh nodes".into(), bytes(self.nodes.len(), NODE_BYTES), NODE_BYTES, Coding::Records),
            ("photons".into(), bytes(self.points.len(), photon), photon, Coding::Records),
        ])
    }

    fn len(&self) -> usize {
        self.points.len()
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        if !self.nodes.is_empty() {
            split_tree::search::<MAX_DEPTH>(self, 0, point, found, eyes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_widened_volume_is_that_of_the_parallel_body() {
        let point = ([1.0; 3], [1.0; 3]);
        assert!((widened_volume(&point, 2.0) - 4.0 / 3.0 * PI * 8.0).abs() < 1e-12, "a ball");
        let stick = ([0.0; 3], [3.0, 0.0, 0.0]);
        assert!((widened_volume(&stick, 1.0) - (3.0 * PI + 4.0 / 3.0 * PI)).abs() < 1e-12, "a cylinder with two caps");
        assert!((widened_volume(&([0.0; 3], [2.0, 3.0, 4.0]), 0.0) - 24.0).abs() < 1e-12, "the box itself");
    }

    #[test]
    fn the_best_split_is_the_best_of_all() {
        // Two clusters on a flat cell: every split tried by hand, with its exact counts.
        let mut points: Vec<Point> = (0..40u16)
            .map(|i| {
                let at = f32::from(i % 20) * 0.01 + if i < 20 { 0.0 } else { 0.7 };
                Point { position: [at, f32::from(i * 7 % 40) * 0.02, 0.0], id: u32::from(i) }
            })
            .collect();
        let cell = extent(points.iter().map(|point| point.position));
        let radius = 0.05;
        let work = |axis: usize, plane: f32| {
            let (mut left, mut right) = (cell, cell);
            left.1[axis] = plane;
            right.0[axis] = plane;
            (left, right)
        };
        let mut least = f64::INFINITY;
        for axis in 0..2 {
            for point in &points {
                let plane = point.position[axis];
                let (left, right) = work(axis, plane);
                for inclusive in [false, true] {
                    let is_left = |p: &&Point| p.position[axis] < plane || inclusive && p.position[axis] <= plane;
                    let n = points.iter().filter(is_left).count();
                    if n > 0 && n < points.len() {
                        let cost = n as f64 * widened_volume(&left, radius)
                            + (points.len() - n) as f64 * widened_volume(&right, radius);
                        least = least.min(cost);
                    }
                }
            }
        }
        let (axis, left, plane) = best_split(&mut points, &cell, radius).unwrap();
        let (left_cell, right_cell) = work(axis, plane);
        let cost = left as f64 * widened_volume(&left_cell, radius)
            + (points.len() - left) as f64 * widened_volume(&right_cell, radius);
        assert!((cost - least).abs() < 1e-12 * least, "{cost} {least}");
        assert!(points[..left].iter().all(|p| p.position[axis] <= plane));
        assert!(points[left..].iter().all(|p| p.position[axis] >= plane));
    }
}
