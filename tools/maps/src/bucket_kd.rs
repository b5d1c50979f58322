//! A kd-tree whose split planes lie apart from the photons, which lie in leaves of one line.
//!
//! The planes are few and small: a cache keeps the upper ones. A leaf is read as a whole, so that nothing that is fetched
//! is of no use to anybody, and its distances are computed side by side.

use super::layout::{Layout, left_size, place};
use super::leaves::{Leaves, Point};
use super::split_tree::{self, Node, SplitTree};
use super::{AccessObserver, BuildError, Nearest, PhotonMap, check, extent, longest_axis};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};

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
    places: Vec<u32>,
    leaves: Leaves,
    photons: usize,
    line: u32,
}

/// A gap between two sets of photons, in eight bytes.
#[derive(Clone, Copy, Default)]
struct Split {
    /// The largest coordinate on the left, rounded up to a multiple of four units in the last place; the axis in the two
    /// bits that this leaves.
    low_and_axis: u32,
    /// The least coordinate on the right.
    high: f32,
}

impl Split {
    fn new(axis: usize, low: f32, high: f32) -> Self {
        let bits = low.to_bits();
        // Up is away from zero above it and towards zero below it.
        let up = if low.is_sign_negative() { bits & !3 } else { (bits + 3) & !3 };
        Self { low_and_axis: up | axis as u32, high }
    }

    #[inline(always)]
    const fn low(self) -> f32 {
        f32::from_bits(self.low_and_axis & !3)
    }

    #[inline(always)]
    const fn axis(self) -> usize {
        (self.low_and_axis & 3) as usize
    }
}

impl BucketKdTree {
    /// Builds the tree in O(n log n): medians along the longest side of the photons' bounds, every leaf full but one.
    ///
    /// # Errors
    /// See [`BuildError`].
    ///
    /// # Panics
    /// If a line has no room for a photon.
    pub fn build(photons: &[Photon], layout: Layout, line: u32) -> Result<Self, BuildError> {
        check(photons)?;
        let capacity = line as usize / size_of::<Photon>();
        assert!(capacity > 0, "a photon must fit a line");
        let count = photons.len().div_ceil(capacity);
        let inner = count.saturating_sub(1);
        let mut tree = Self {
            splits: vec![Split::default(); inner],
            places: layout.places(inner),
            leaves: Leaves::new(count, capacity),
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
        points.select_nth_unstable_by(left_leaves * capacity, Point::along(axis));
        let (left, right) = points.split_at_mut(left_leaves * capacity);
        let low = left.iter().fold(f32::NEG_INFINITY, |low, point| low.max(point.position[axis]));
        self.splits[at - 1] = Split::new(axis, low, right[0].position[axis]);
        self.divide(2 * at, left_leaves, capacity, left);
        self.divide(2 * at + 1, leaves - left_leaves, capacity, right);
    }
}

impl SplitTree for BucketKdTree {
    #[inline(always)]
    fn node(&self, at: u32, eyes: &mut impl AccessObserver) -> Node {
        let Some(split) = self.splits.get(at as usize - 1) else {
            return Node::Leaf(at - 1 - self.splits.len() as u32);
        };
        eyes.read(SPLITS, place(&self.places, at as usize));
        Node::Split { axis: split.axis(), low: split.low(), high: split.high, left: 2 * at, right: 2 * at + 1 }
    }

    #[inline(always)]
    fn leaf(&self, leaf: u32, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        eyes.read(LEAVES, leaf);
        eyes.examined(self.leaves.count(leaf as usize));
        self.leaves.show(leaf as usize, point, found);
    }
}

impl PhotonMap for BucketKdTree {
    fn regions(&self, _: bool) -> Vec<Region> {
        let split = size_of::<Split>() as u32;
        let bytes = |count: usize, record: u32| count as u64 * u64::from(record);
        lay_out([
            ("splits".into(), bytes(self.splits.len(), split), split, Coding::Records),
            ("photon leaves".into(), bytes(self.leaves.len(), self.line), self.line, Coding::Records),
        ])
    }

    fn len(&self) -> usize {
        self.photons
    }

    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        if self.photons > 0 {
            split_tree::search::<MAX_DEPTH>(self, 1, point, found, eyes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_split_is_never_below_its_left_side_and_hardly_above() {
        for low in [0.0, -0.0, 1.0, -1.0, 1e18, -1e18, 1e-40, -1e-40, 0.1, -0.3, f32::MIN_POSITIVE] {
            for axis in 0..3 {
                let split = Split::new(axis, low, 7.0);
                assert_eq!(split.axis(), axis);
                assert!(split.low() >= low && split.low() - low <= low.abs() * 4e-7 + 1e-44, "{low} {}", split.low());
            }
        }
    }

    #[test]
    fn every_leaf_is_full_but_one() {
        for n in [0, 1, 5, 6, 7, 36, 37, 1000] {
            let positions = (0..n).map(|i: u16| [f32::from(i * 7 % 11), f32::from(i), 0.0]);
            let photons: Vec<_> = positions
                .map(|p| Photon::new(p, [1.0; 3], [0.5; 3], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]).unwrap())
                .collect();
            let tree = BucketKdTree::build(&photons, Layout::Heap, 128).unwrap();
            let counts: Vec<_> = (0..tree.leaves.len()).map(|leaf| tree.leaves.count(leaf)).collect();
            assert_eq!(counts.iter().sum::<usize>(), photons.len());
            assert!(counts.iter().filter(|&&count| count < 6).count() <= 1, "{counts:?}");
        }
    }
}
