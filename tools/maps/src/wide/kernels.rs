//! What is asked of sixteen lanes at once, by three kinds of instructions.
//!
//! All compute squared distances by the very operations of [`distance_squared`](crate::geometry::distance_squared), so that they find
//! the same photons at the same distances, and a box is never farther than a photon in it: rounding is monotonous.

#![expect(clippy::needless_range_loop, reason = "loops over lanes, which compilers turn into vector code")]

use super::{Boxes, Leaf, WIDTH};
use crate::candidates::Candidates;

/// What is done with the lanes, whatever the instructions.
pub(super) trait Work {
    /// What comes of it.
    type Found;

    /// Does it. It has to be inlined, and so has all that it calls with `K`: into a function that may use the instructions.
    fn run<K: Kernels>(self) -> Self::Found;
}

/// The lanes of a node or of a leaf.
pub(super) trait Kernels {
    /// The lanes (a bit each) whose squared distance is at most `bound`.
    fn within(distances: &[f32; WIDTH], bound: f32) -> u32;

    /// Puts the lanes of `mask` there, from `at` on, where there is room for sixteen.
    fn append_to(to: (&mut [f32], &mut [u32]), at: usize, distances: &[f32; WIDTH], places: &[u32; WIDTH], mask: u32);

    /// The same where the places of the lanes are those from `first` on.
    fn append_leaf(to: (&mut [f32], &mut [u32]), at: usize, distances: &[f32; WIDTH], first: u32, mask: u32);

    /// Puts the lanes of `mask` there, from `at` on, where there is room for sixteen.
    fn pack(to: &mut [f32], at: usize, lanes: &[f32; WIDTH], mask: u32);

    /// Appends the lanes of `mask`, counted from `first` on. There is room for sixteen.
    fn append_numbers(to: &mut [u32], len: &mut usize, first: u32, mask: u32);

    /// Appends the lanes of `mask`. There is room for sixteen.
    #[inline(always)]
    fn append(candidates: &mut Candidates, distances: &[f32; WIDTH], places: &[u32; WIDTH], mask: u32) {
        let to = (&mut candidates.distances[..], &mut candidates.places[..]);
        Self::append_to(to, candidates.len, distances, places, mask);
        candidates.len += mask.count_ones() as usize;
    }

    /// How many of these are at most `bound`.
    #[inline(always)]
    fn count(distances: &[[f32; WIDTH]], bound: f32) -> usize {
        let mut count = 0;
        for lanes in distances {
            count += Self::within(lanes, bound).count_ones();
        }
        count as usize
    }
}

/// Squared distances of the boxes of a node; NaN where there is none.
#[inline(always)]
pub(super) fn box_distances(boxes: &Boxes, point: [f32; 3]) -> [f32; WIDTH] {
    // Loops and no closures: a closure would be compiled for the instructions that every machine has.
    let mut distances = [0.0; WIDTH];
    for lane in 0..WIDTH {
        let mut beyond = [0.0; 3];
        for axis in 0..3 {
            let (below, above) = (boxes.low[axis][lane] - point[axis], point[axis] - boxes.high[axis][lane]);
            let larger = if below > above { below } else { above };
            // NaN stays.
            beyond[axis] = if larger < 0.0 { 0.0 } else { larger };
        }
        let [dx, dy, dz] = beyond;
        distances[lane] = (dx * dx + dy * dy) + dz * dz;
    }
    distances
}

/// Squared distances of the photons of a leaf; NaN where there is none.
#[inline(always)]
pub(super) fn leaf_distances(leaf: &Leaf, point: [f32; 3]) -> [f32; WIDTH] {
    let mut distances = [0.0; WIDTH];
    for lane in 0..WIDTH {
        let [x, y, z] = &leaf.position;
        distances[lane] = crate::geometry::distance_squared(point, [x[lane], y[lane], z[lane]]);
    }
    distances
}

/// Plain loops.
pub(super) struct Plain;

impl Kernels for Plain {
    #[inline(always)]
    fn within(distances: &[f32; WIDTH], bound: f32) -> u32 {
        let mut mask = 0;
        for lane in 0..WIDTH {
            mask |= u32::from(distances[lane] <= bound) << lane;
        }
        mask
    }

    #[inline(always)]
    fn append_to(
        (to_distances, to_places): (&mut [f32], &mut [u32]),
        at: usize,
        distances: &[f32; WIDTH],
        places: &[u32; WIDTH],
        mut mask: u32,
    ) {
        let (to_distances, to_places) = (&mut to_distances[at..][..WIDTH], &mut to_places[at..][..WIDTH]);
        let mut number = 0;
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize % WIDTH;
            mask &= mask - 1;
            to_distances[number % WIDTH] = distances[lane];
            to_places[number % WIDTH] = places[lane];
            number += 1;
        }
    }

    #[inline(always)]
    fn append_leaf(to: (&mut [f32], &mut [u32]), at: usize, distances: &[f32; WIDTH], first: u32, mask: u32) {
        if mask == 0 {
            return;
        }
        let (to_distances, to_places) = (&mut to.0[at..][..WIDTH], &mut to.1[at..][..WIDTH]);
        // All of them, the next over one that is not wanted: no processor foresees a mask.
        let mut number = 0;
        for lane in 0..WIDTH {
            to_distances[number % WIDTH] = distances[lane];
            to_places[number % WIDTH] = first + lane as u32;
            number += (mask >> lane & 1) as usize;
        }
    }

    #[inline(always)]
    fn pack(to: &mut [f32], at: usize, lanes: &[f32; WIDTH], mask: u32) {
        if mask == 0 {
            return;
        }
        let to = &mut to[at..][..WIDTH];
        let mut number = 0;
        for lane in 0..WIDTH {
            to[number % WIDTH] = lanes[lane];
            number += (mask >> lane & 1) as usize;
        }
    }

    #[inline(always)]
    fn append_numbers(to: &mut [u32], len: &mut usize, first: u32, mut mask: u32) {
        while mask != 0 {
            to[*len] = first + mask.trailing_zeros();
            mask &= mask - 1;
            *len += 1;
        }
    }

    #[inline(always)]
    fn count(distances: &[[f32; WIDTH]], bound: f32) -> usize {
        let mut counts = [0; WIDTH];
        for lanes in distances {
            for lane in 0..WIDTH {
                counts[lane] += u32::from(lanes[lane] <= bound);
            }
        }
        let mut count = 0;
        for lane in counts {
            count += lane;
        }
        count as usize
    }
}
