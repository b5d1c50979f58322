//! Median splits, cut into nodes of sixteen.

use super::{Boxes, Instructions, Leaf, Level, WIDTH, WideTree};
use crate::geometry::{Box3, extent, longest_axis};
use crate::point::Point;
use crate::select_nth::select_nth;
use pm_formats::Photon;
use std::sync::Arc;

/// Not a box: nothing is near it.
const NO_BOXES: Boxes = Boxes { low: [[f32::NAN; WIDTH]; 3], high: [[f32::NAN; WIDTH]; 3] };
/// No photons.
const EMPTY: Leaf = Leaf { position: [[f32::NAN; WIDTH]; 3] };

/// The tree of photons that were checked.
pub(super) fn build(photons: &[Photon], instructions: Instructions) -> WideTree {
    let leaves = photons.len().div_ceil(WIDTH);
    // Numbers of nodes, level by level from the one above the leaves up to the root.
    let mut counts = vec![];
    let mut below = leaves;
    while below > 1 || (below == 1 && counts.is_empty()) {
        below = below.div_ceil(WIDTH);
        counts.push(below);
    }
    counts.reverse();
    let mut levels = vec![];
    let mut first = 0;
    for (depth, count) in counts.iter().enumerate() {
        levels.push(Level { first, photons: (WIDTH as u64).pow((counts.len() - depth) as u32 + 1) });
        first += *count as u32;
    }
    let nodes = vec![NO_BOXES; first as usize];
    let ids = Arc::default();
    let mut tree =
        WideTree { levels, nodes, leaves: vec![EMPTY; leaves], ids, photons: photons.len(), instructions, group: 1 };
    let mut points = Point::all(photons);
    if leaves > 0 {
        tree.divide(0, 0, &mut points);
    }
    // All leaves but the last are full: the photons lie as they were sorted.
    tree.ids = points.iter().map(|point| point.id).collect();
    tree
}

impl WideTree {
    /// Makes node `at` of the level `depth` from these photons, and all that lies below it.
    fn divide(&mut self, depth: usize, at: usize, points: &mut [Point]) {
        let in_child = self.levels[depth].photons as usize / WIDTH;
        let children = points.len().div_ceil(in_child);
        self.share(depth, at, 0..children, in_child, points);
    }

    /// Shares photons out among these children of a node: halves along the longest side, until a child has its own.
    fn share(&mut self, depth: usize, at: usize, lanes: std::ops::Range<usize>, in_child: usize, points: &mut [Point]) {
        let bounds = extent(points.iter().map(|point| point.position));
        if lanes.len() == 1 {
            self.child(depth, at, lanes.start, &bounds, points);
            return;
        }
        let middle = lanes.start + lanes.len().div_ceil(2);
        let left = (middle - lanes.start) * in_child;
        select_nth(points, left, longest_axis(&bounds));
        let (below, above) = points.split_at_mut(left);
        self.share(depth, at, lanes.start..middle, in_child, below);
        self.share(depth, at, middle..lanes.end, in_child, above);
    }

    /// A child with its box.
    fn child(&mut self, depth: usize, at: usize, lane: usize, bounds: &Box3, points: &mut [Point]) {
        let boxes = &mut self.nodes[self.levels[depth].first as usize + at];
        for axis in 0..3 {
            boxes.low[axis][lane] = bounds.0[axis];
            boxes.high[axis][lane] = bounds.1[axis];
        }
        let child = at * WIDTH + lane;
        if depth + 1 < self.levels.len() {
            self.divide(depth + 1, child, points);
            return;
        }
        let leaf = &mut self.leaves[child];
        for (lane, point) in points.iter().enumerate() {
            for axis in 0..3 {
                leaf.position[axis][lane] = point.position[axis];
            }
        }
    }
}
