//! A kd-tree whose split planes lie apart from the photons, which lie in leaves of one line.
//!
//! The planes are few and small: a cache keeps the upper ones. A leaf is read as a whole, so that nothing that is fetched
//! is of no use to anybody, and its distances are computed side by side.

mod split;

use super::error::check;
use super::geometry::{extent, longest_axis};
use super::layout::{Layout, left_size, record_of};
use super::photon_blocks::PhotonBlocks;
use super::point::Point;
use super::select_nth::select_nth;
use super::split_tree::{self, Node, SplitTree};
use super::{AccessObserver, BuildError, Nearest, PhotonMap};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, Waits, lay_out};
use split::Split;

/// Deepest tree of at most 2^30 leaves.
const MAX_DEPTH: usize = 32;

/// Number of the region that holds the split planes.
const SPLITS: u16 = 0;
/// Number of the region that holds the photons.
const LEAVES: u16 = 1;

/// The tree: of its nodes 1, 2, ..., those below the number of leaves are splits, with children 2i and 2i + 1, and the
/// others leaves.
pub struct BucketKdTree {
    /// Node i at index i - 1.
    splits: Vec<Split>,
    /// Which record of the traced memory each split is; empty if node i is record i - 1.
    records: Vec<u32>,
    leaves: PhotonBlocks,
    photons: usize,
    line: u32,
}

impl BucketKdTree {
    /// Builds the tree in O(n log n): medians along the longest side of the photons' bounds, every leaf full but one.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon], layout: Layout, line: u32) -> Result<Self, BuildError> {
        check(photons)?;
        BuildError::unless_fits(line, size_of::<Photon>() as u32)?;
        let capacity = line as usize / size_of::<Photon>();
        let count = photons.len().div_ceil(capacity);
        let inner = count.saturating_sub(1);
        let mut tree = Self {
            splits: vec![Split::default(); inner],
            records: layout.records(inner),
            leaves: PhotonBlocks::new(count, capacity),
            photons: photons.len(),
            line,
        };
        tree.divide(1, count, capacity, &mut Point::all(photons));
        Ok(tree)
    }

    /// Makes node `at`, of so many leaves, from these photons.
    fn divide(&mut self, at: usize, leaves: usize, capacity: usize, points: &mut [Point]) {
        match leaves {
            0 => return,
            1 => return self.leaves.fill(at - self.leaves.len(), points),
            _ => {}
        }
        // A tree of n leaves has 2n - 1 nodes.
        let left_leaves = left_size(2 * leaves - 1).div_ceil(2);
        let axis = longest_axis(&extent(points.iter().map(|point| point.position)));
        select_nth(points, left_leaves * capacity, axis);
        let (left, right) = points.split_at_mut(left_leaves * capacity);
        let low = left.iter().fold(f32::NEG_INFINITY, |low, point| low.max(point.position[axis]));
        self.splits[at - 1] = Split::new(axis, low, right[0].position[axis]);
        self.divide(2 * at, left_leaves, capacity, left);
        self.divide(2 * at + 1, leaves - left_leaves, capacity, right);
    }
}

/// What a node waits for: the one above.
#[inline(always)]
fn waits(node: u32) -> Waits {
    Waits::last_above(node.checked_ilog2().unwrap_or(0) as u16)
}

impl SplitTree for BucketKdTree {
    #[inline(always)]
    fn node(&self, at: u32, eyes: &mut impl AccessObserver) -> Node {
        let Some(split) = self.splits.get(at as usize - 1) else {
            return Node::Leaf(at);
        };
        eyes.read_after(SPLITS, record_of(&self.records, at as usize), waits(at));
        Node::Split { axis: split.axis(), low: split.low(), high: split.high, left: 2 * at, right: 2 * at + 1 }
    }

    #[inline(always)]
    fn leaf(&self, at: u32, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        let leaf = at - 1 - self.splits.len() as u32;
        eyes.read_after(LEAVES, leaf, waits(at));
        eyes.examined(self.leaves.count(leaf as usize));
        self.leaves.show(leaf as usize, point, found);
    }
}

impl PhotonMap for BucketKdTree {
    fn regions(&self, _: bool) -> Vec<Region> {
        let split = size_of::<Split>() as u32;
        let bytes = |count: usize, record: u32| count as u64 * u64::from(record);
        let (above, below) = if self.records.is_empty() {
            (Coding::LeavesApart { leaves: self.leaves.len() as u32 }, Coding::Records)
        } else {
            (Coding::InTurns, Coding::InTurns)
        };
        lay_out([
            ("splits".into(), bytes(self.splits.len(), split), split, above),
            ("photon leaves".into(), bytes(self.leaves.len(), self.line), self.line, below),
        ])
    }

    fn len(&self) -> usize {
        self.photons
    }

    fn tells_waits(&self) -> bool {
        true
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        if self.photons > 0 {
            split_tree::search::<MAX_DEPTH>(self, 1, point, found, eyes);
        }
    }
}

#[cfg(test)]
mod tests;
