//! The one search, whatever the instructions.

use super::kernels::{Kernels, box_distances, leaf_distances};
use super::select::{select, shrink};
use super::{LEAVES, NODES, WIDTH, WideTree};
use crate::nearest::distance_of;
use crate::{AccessObserver, Nearest};

/// Levels of the largest tree: 2^30 photons in leaves of 16, and 16 children a node.
const MOST_LEVELS: usize = 8;

/// Finds the photons nearest to `point` within the bound of `found`.
#[inline(always)]
pub(super) fn search<K: Kernels>(
    tree: &WideTree,
    point: [f32; 3],
    found: &mut Nearest,
    eyes: &mut impl AccessObserver,
) {
    let (k, mut bound) = (found.k(), found.bound());
    if bound >= f32::MAX && k < tree.photons {
        bound = bound.min(enough(tree, point, k, eyes));
    }
    let candidates = &mut found.candidates;
    candidates.clear(room(k.min(tree.photons)));
    let last = tree.levels.len() - 1;
    // Number of a node, and its children that are yet to be visited.
    let mut open = [(0_u32, 0_u32); MOST_LEVELS];
    let mut depth = 0;
    let mut at = 0_u32;
    loop {
        let node = tree.levels[depth].first + at;
        eyes.read(NODES, node);
        let mut near = K::within(&box_distances(&tree.nodes[node as usize], point), bound);
        if depth == last {
            while near != 0 {
                let number = at * WIDTH as u32 + near.trailing_zeros();
                near &= near - 1;
                let leaf = &tree.leaves[number as usize];
                eyes.read(LEAVES, number);
                eyes.examined(WIDTH);
                let distances = leaf_distances(leaf, point);
                K::append(candidates, &distances, &leaf.id, K::within(&distances, bound));
                if candidates.len > candidates.most() {
                    bound = bound.min(distance_of(shrink(candidates, k)));
                }
            }
        } else {
            open[depth] = (at, near);
            depth += 1;
        }
        // The next child of the deepest node that has one left.
        loop {
            if depth == 0 {
                select::<K>(found, bound);
                return;
            }
            let (above, left) = &mut open[depth - 1];
            if *left != 0 {
                at = *above * WIDTH as u32 + left.trailing_zeros();
                *left &= *left - 1;
                break;
            }
            depth -= 1;
        }
    }
}

/// Candidates that are collected before the nearest of them are selected, a leaf less.
fn room(k: usize) -> usize {
    (4 * k).clamp(k + 1024, k + 8192)
}

/// A squared distance within which at least `k` photons lie: that to the far corner of a box that holds so many, on the way
/// down to the nearest.
#[cold]
fn enough(tree: &WideTree, point: [f32; 3], k: usize, eyes: &mut impl AccessObserver) -> f32 {
    let (mut at, mut bound) = (0_usize, f32::INFINITY);
    for level in &tree.levels {
        let in_child = level.photons / WIDTH as u64;
        if in_child < k as u64 {
            break;
        }
        let node = level.first as usize + at;
        eyes.read(NODES, node as u32);
        let boxes = &tree.nodes[node];
        let distances = box_distances(boxes, point);
        // Only the last of a level is not full.
        let full = |lane: usize| ((at * WIDTH + lane + 1) as u64) * in_child <= tree.photons as u64;
        let nearest = (0..WIDTH).filter(|&lane| full(lane)).min_by(|&a, &b| distances[a].total_cmp(&distances[b]));
        let Some(lane) = nearest else { break };
        let far = |axis: usize| {
            let (low, high) = (point[axis] - boxes.low[axis][lane], point[axis] - boxes.high[axis][lane]);
            low.abs().max(high.abs())
        };
        let [x, y, z] = [far(0), far(1), far(2)];
        bound = bound.min((x * x + y * y) + z * z);
        at = at * WIDTH + lane;
    }
    bound
}
