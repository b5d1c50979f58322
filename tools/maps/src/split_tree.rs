//! The search that all binary trees with photons in their leaves share.

use super::{AccessObserver, Nearest};

/// What a node of such a tree is.
pub(super) enum Node {
    /// Photons, under a number that the tree knows them by.
    Leaf(u32),
    /// Two children: coordinates along `axis` are at most `low` in the left and at least `high` in the right one.
    Split { axis: usize, low: f32, high: f32, left: u32, right: u32 },
}

/// A binary tree of split planes with photons in the leaves.
pub(super) trait SplitTree {
    /// Reads a node.
    fn node(&self, at: u32, eyes: &mut impl AccessObserver) -> Node;

    /// Reads a leaf and shows its photons.
    fn leaf(&self, leaf: u32, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver);
}

/// A subtree yet to be visited.
#[derive(Clone, Copy)]
struct Later {
    at: u32,
    distance: f32,
    offsets: [f32; 3],
}

/// Depth first, the nearer child first. `DEEPEST` is at least the tree's depth.
///
/// A subtree's distance is that of its cell: how far the query lies outside it along each axis, kept up to date plane by
/// plane (Arya and Mount, *Algorithms for fast vector quantization*, DCC 1993). Each of these offsets is rounded as a
/// photon's own difference in that coordinate is, and summed in the same order, so that no photon of the subtree is
/// nearer than that, rounding included.
#[inline]
pub(super) fn search<const DEEPEST: usize>(
    tree: &impl SplitTree,
    root: u32,
    point: [f32; 3],
    found: &mut Nearest,
    eyes: &mut impl AccessObserver,
) {
    let squared = |o: [f32; 3]| (o[0] * o[0] + o[1] * o[1]) + o[2] * o[2];
    let mut later = [Later { at: 0, distance: 0.0, offsets: [0.0; 3] }; DEEPEST];
    let mut depth = 0;
    let (mut at, mut offsets) = (root, [0f32; 3]);
    loop {
        match tree.node(at, eyes) {
            Node::Leaf(leaf) => tree.leaf(leaf, point, found, eyes),
            Node::Split { axis, low, high, left, right } => {
                // How far outside the one and the other child; negative inside.
                let (beyond_left, beyond_right) = (point[axis] - low, high - point[axis]);
                let (near, far, near_offset, far_offset) = if beyond_left <= beyond_right {
                    (left, right, beyond_left, beyond_right)
                } else {
                    (right, left, beyond_right, beyond_left)
                };
                let mut far_offsets = offsets;
                far_offsets[axis] = offsets[axis].max(far_offset);
                let distance = squared(far_offsets);
                if distance <= found.bound() {
                    later[depth] = Later { at: far, distance, offsets: far_offsets };
                    depth += 1;
                }
                offsets[axis] = offsets[axis].max(near_offset);
                // Not so where the query lies in the gap between the two.
                if near_offset <= 0.0 || squared(offsets) <= found.bound() {
                    at = near;
                    continue;
                }
            }
        }
        loop {
            if depth == 0 {
                return;
            }
            depth -= 1;
            // Not `<`: a photon as far as the farthest found may have the smaller id.
            if later[depth].distance <= found.bound() {
                (at, offsets) = (later[depth].at, later[depth].offsets);
                break;
            }
        }
    }
}
