//! The one search, whatever the instructions.
//!
//! Nodes are visited level by level, as long as there is room to set their children aside: how often a loop goes round is then
//! known once a level, and not once a node, and processors foresee it.

use super::kernels::{Kernels, Work, box_distances, leaf_distances};
use super::select::select;
use super::{LEAVES, NODES, WIDTH, WideTree};
use crate::candidates::{Candidates, MOST_OPEN, Open, Room};
use crate::{AccessObserver, Nearest};

/// Between which squared distances the k-th lies: all within `floor` are among the nearest, none beyond `bound` is.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) floor: f32,
    pub(super) bound: f32,
}

/// Finds the photons nearest to a point within the bound of `found`.
pub(super) struct Find<'a, E> {
    pub(super) tree: &'a WideTree,
    pub(super) point: [f32; 3],
    pub(super) found: &'a mut Nearest,
    pub(super) eyes: &'a mut E,
}

impl<E: AccessObserver> Work for Find<'_, E> {
    type Found = ();

    #[inline(always)]
    fn run<K: Kernels>(self) {
        let Self { tree, point, found, eyes } = self;
        let k = found.k();
        let mut bounds = Bounds { floor: found.floor(), bound: found.bound() };
        if bounds.bound >= f32::MAX && k < tree.photons {
            bounds.bound = bounds.bound.min(enough(tree, point, k, eyes));
        }
        let room = &mut found.room;
        room.clear(k.min(tree.photons));
        let Room { chosen, shell, open } = room;
        let mut nearest = Sorted { bounds, k, chosen, shell };
        walk::<K>(tree, point, &mut nearest, open, eyes);
        bounds = nearest.bounds;
        select::<K>(found, bounds, &tree.ids);
    }
}

/// What becomes of the leaves that are reached.
pub(super) trait Leaves {
    /// Squared distance within which boxes are opened.
    fn bound(&self) -> f32;

    /// Reads all leaves that are open; `false` ends the walk.
    fn read<K: Kernels>(
        &mut self,
        tree: &WideTree,
        point: [f32; 3],
        open: &Open,
        eyes: &mut impl AccessObserver,
    ) -> bool;
}

/// Goes down to all leaves within a bound.
#[inline(always)]
pub(super) fn walk<K: Kernels>(
    tree: &WideTree,
    point: [f32; 3],
    leaves: &mut impl Leaves,
    open: &mut [Open],
    eyes: &mut impl AccessObserver,
) {
    let last = tree.levels.len() - 1;
    let mut depth = 0;
    open[0].numbers[0] = 0;
    (open[0].len, open[0].visited) = (1, 0);
    loop {
        open_children::<K>(tree, depth, point, leaves.bound(), open, eyes);
        if depth < last {
            depth += 1;
            // Below, if there is anything.
            if open[depth].len > 0 {
                continue;
            }
        } else if !leaves.read::<K>(tree, point, &open[tree.levels.len()], eyes) {
            return;
        }
        // The deepest level that has a node left.
        while open[depth].visited == open[depth].len {
            if depth == 0 {
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
    open: &mut [Open],
    eyes: &mut impl AccessObserver,
) {
    let [level, below, ..] = &mut open[depth..] else { return };
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

/// Sorts out the photons: sure to be among the nearest, perhaps, or not.
struct Sorted<'a> {
    bounds: Bounds,
    k: usize,
    chosen: &'a mut Candidates,
    shell: &'a mut Candidates,
}

impl Leaves for Sorted<'_> {
    #[inline(always)]
    fn bound(&self) -> f32 {
        self.bounds.bound
    }

    #[inline(always)]
    fn read<K: Kernels>(
        &mut self,
        tree: &WideTree,
        point: [f32; 3],
        open: &Open,
        eyes: &mut impl AccessObserver,
    ) -> bool {
        let Self { bounds, k, chosen, shell } = self;
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
                bounds.bound = bounds.bound.min(shell.shrink(*k, &tree.ids));
                shell_len = *k;
            }
        }
        (chosen.len, shell.len) = (chosen_len, shell_len);
        true
    }
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
