//! The search of the left-balanced kd-tree.

use super::KdTree;
use crate::geometry::distance_squared;
use crate::{AccessObserver, Nearest};
use pm_formats::trace::Waits;

/// Deepest tree of at most 2^30 nodes, and one more.
const MAX_DEPTH: usize = 32;

/// What a node waits for: the one above.
#[inline(always)]
fn waits(node: usize) -> Waits {
    Waits::last_above(node.checked_ilog2().unwrap_or(0) as u16)
}

/// Jensen's search: the child on the query's side first, then the other if the splitting plane lies within the
/// bound, then the node's own photon. A node is read when it is reached, and the inner ones are looked at again for
/// their own photon.
pub(super) fn nearest(tree: &KdTree, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
    let nodes = &tree.nodes[..];
    let count = nodes.len();
    if count == 0 {
        return;
    }
    // Nodes above whose second child and own photon are still to be looked at: node, second child (0: done with),
    // squared distance to the splitting plane.
    let mut above = [(0u32, 0u32, 0f32); MAX_DEPTH];
    let mut depth = 0;
    let mut at = 1;
    loop {
        let node = &nodes[at - 1];
        eyes.read_after(0, tree.record(at), waits(at));
        eyes.examined(1);
        let left = 2 * at;
        if left <= count {
            let axis = node.axis();
            let delta = point[axis] - node.position[axis];
            let (near, far) = if delta > 0.0 { (left + 1, left) } else { (left, left + 1) };
            if near <= count {
                above[depth] = (at as u32, if far <= count { far as u32 } else { 0 }, delta * delta);
                depth += 1;
                at = near;
                continue;
            }
            // The only child lies on the other side.
            if delta * delta <= found.bound() {
                above[depth] = (at as u32, 0, 0.0);
                depth += 1;
                at = far;
                continue;
            }
            eyes.reread(0, tree.record(at));
        }
        found.show(distance_squared(point, node.position), node.id());
        loop {
            if depth == 0 {
                return;
            }
            let (parent, far, plane) = above[depth - 1];
            // Not `<`: a photon as far as the farthest found may have the smaller id.
            if far != 0 && plane <= found.bound() {
                above[depth - 1].1 = 0;
                at = far as usize;
                break;
            }
            depth -= 1;
            eyes.reread(0, tree.record(parent as usize));
            let node = &nodes[parent as usize - 1];
            found.show(distance_squared(point, node.position), node.id());
        }
    }
}
