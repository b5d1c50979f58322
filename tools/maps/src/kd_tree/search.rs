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
    // Nodes above whose second child and own photon are still to be looked at: node, second child, squared distance to the
    // splitting plane (no number if done with).
    let mut above = [(0u32, 0u32, 0f32); MAX_DEPTH];
    let mut depth = 0;
    let mut at = 1;
    loop {
        let node = &nodes[at - 1];
        eyes.read_after(0, tree.record(at), waits(at));
        eyes.examined(1);
        let left = 2 * at;
        let axis = node.axis();
        let delta = point[axis] - node.position[axis];
        let plane = delta * delta;
        let (near, far) = if delta > 0.0 { (left + 1, left) } else { (left, left + 1) };
        if 2 * left <= count {
            above[depth] = (at as u32, far as u32, plane);
            depth += 1;
            at = near;
            continue;
        }
        if left < count {
            last_three(tree, point, [at, near, far], plane, found, eyes);
        } else {
            // An only child is a left one, and has none.
            if left == count && (near == left || plane <= found.bound()) {
                let child = &nodes[left - 1];
                eyes.read_after(0, tree.record(left), waits(left));
                eyes.examined(1);
                found.show(distance_squared(point, child.position), child.id());
            }
            if left <= count {
                eyes.reread(0, tree.record(at));
            }
            found.show(distance_squared(point, node.position), node.id());
        }
        loop {
            if depth == 0 {
                return;
            }
            let (parent, far, plane) = above[depth - 1];
            // Not `<`: a photon as far as the farthest found may have the smaller id.
            if plane <= found.bound() {
                above[depth - 1].2 = f32::NAN;
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

/// The last of a search's way down: a node that has been read, and its children, who have none. The three are half and a quarter of
/// all that is read, and who guesses at each whether it will be kept guesses wrong too often: so all three are looked at before.
#[inline(always)]
fn last_three(
    tree: &KdTree,
    point: [f32; 3],
    [node, near, far]: [usize; 3],
    plane: f32,
    found: &mut Nearest,
    eyes: &mut impl AccessObserver,
) {
    let of = |node: usize| {
        let node = &tree.nodes[node - 1];
        (distance_squared(point, node.position), node.id())
    };
    let (this, first, second) = (of(node), of(near), of(far));
    let bound = found.bound();
    eyes.read_after(0, tree.record(near), waits(near));
    eyes.examined(1);
    // Is the second one looked at, if the bound stays?
    let both = plane <= bound;
    let kept = [first.0 <= bound, both & (second.0 <= bound), this.0 <= bound];
    let none = !(kept[0] | kept[1] | kept[2]);
    if none || found.bound_stays_with(3) {
        eyes.read_after_if(both, 0, tree.record(far), waits(far));
        eyes.examined(usize::from(both));
        eyes.reread(0, tree.record(node));
        if !none {
            for (kept, (distance, id)) in kept.into_iter().zip([first, second, this]) {
                found.keep_if(kept, distance, id);
            }
        }
        return;
    }
    found.show(first.0, first.1);
    if plane <= found.bound() {
        eyes.read_after(0, tree.record(far), waits(far));
        eyes.examined(1);
        found.show(second.0, second.1);
    }
    eyes.reread(0, tree.record(node));
    found.show(this.0, this.1);
}
