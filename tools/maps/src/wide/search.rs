//! The one search, whatever the instructions.
//!
//! Nodes are visited level by level, as long as there is room to set their children aside: how often a loop goes round is then
//! known once a level, and not once a node, and processors foresee it.

use super::kernels::{Kernels, box_distances, leaf_distances};
use super::select::select;
use super::{LEAVES, NODES, WIDTH, WideTree};
use crate::candidates::{MOST_OPEN, Room};
use crate::{AccessObserver, Nearest};

/// Between which squared distances the k-th lies: all within `floor` are among the nearest, none beyond `bound` is.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) floor: f32,
    pub(super) bound: f32,
}

/// Finds the photons nearest to `point` within the bound of `found`.
#[inline(always)]
pub(super) fn search<K: Kernels>(
    tree: &WideTree,
    point: [f32; 3],
    found: &mut Nearest,
    eyes: &mut impl AccessObserver,
) {
    let k = found.k();
    let mut bounds = Bounds { floor: found.floor(), bound: found.bound() };
    if bounds.bound >= f32::MAX && k < tree.photons {
        bounds.bound = bounds.bound.min(enough(tree, point, k, eyes));
    }
    let room = &mut found.room;
    room.clear(k.min(tree.photons));
    let last = tree.levels.len() - 1;
    let mut depth = 0;
    room.open[0].numbers[0] = 0;
    (room.open[0].len, room.open[0].visited) = (1, 0);
    loop {
        open_children::<K>(tree, depth, point, bounds.bound, room, eyes);
        if depth < last {
            depth += 1;
            // Below, if there is anything.
            if room.open[depth].len > 0 {
                continue;
            }
        } else {
            read_leaves::<K>(tree, point, &mut bounds, k, room, eyes);
        }
        // The deepest level that has a node left.
        while room.open[depth].visited == room.open[depth].len {
            if depth == 0 {
                select::<K>(found, bounds, &tree.ids);
                return;
            }
            depth -= 1;
        }
    }
}

/// Visits nodes of a level until all have been, or there is no room for the children of another.
#[inline(always)]
fn open_children<K: Kernels>(
    tree: &WideTree,
    depth: usize,
    point: [f32; 3],
    bound: f32,
    room: &mut Room,
    eyes: &mut impl AccessObserver,
) {
    let [level, below, ..] = &mut room.open[depth..] else { return };
    (below.len, below.visited) = (0, 0);
    let first = tree.levels[depth].first;
    while level.visited < level.len && below.len <= MOST_OPEN {
        let number = level.numbers[level.visited];
        level.visited += 1;
        let node = first + number;
        eyes.read(NODES, node);
        let near = K::within(&box_distances(&tree.nodes[node as usize], point), bound);
        K::append_numbers(&mut below.numbers, &mut below.len, number * WIDTH as u32, near);
    }
}

/// Sorts out the photons of all leaves that are open.
#[inline(always)]
fn read_leaves<K: Kernels>(
    tree: &WideTree,
    point: [f32; 3],
    bounds: &mut Bounds,
    k: usize,
    room: &mut Room,
    eyes: &mut impl AccessObserver,
) {
    let Room { chosen, shell, open } = room;
    let open = &open[tree.levels.len()];
    // In variables of their own, so that they need not be in memory at any moment.
    let (mut chosen_len, mut shell_len, most) = (chosen.len, shell.len, shell.most());
    for &number in &open.numbers[..open.len] {
        eyes.read(LEAVES, number);
        eyes.examined(WIDTH);
        let distances = leaf_distances(&tree.leaves[number as usize], point);
        let first = number * WIDTH as u32;
        let near = K::within(&distances, bounds.bound);
        let sure = near & K::within(&distances, bounds.floor);
        K::append_leaf((&mut chosen.distances, &mut chosen.places), chosen_len, &distances, first, sure);
        chosen_len += sure.count_ones() as usize;
        K::append_leaf((&mut shell.distances, &mut shell.places), shell_len, &distances, first, near & !sure);
        shell_len += (near & !sure).count_ones() as usize;
        if shell_len > most {
            shell.len = shell_len;
            bounds.bound = bounds.bound.min(shell.shrink(k, &tree.ids));
            shell_len = k;
        }
    }
    (chosen.len, shell.len) = (chosen_len, shell_len);
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
