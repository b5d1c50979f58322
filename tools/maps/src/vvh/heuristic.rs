//! The voxel volume heuristic: which split makes the least expected work.

use crate::geometry::{Box3, extent};
use crate::point::Point;
use crate::select_nth::select_nth;
use std::f64::consts::PI;

/// Sets of more photons than this are split at the rims of [`BINS`] bins a side, smaller ones at any photon.
const FEW: usize = 256;
const BINS: usize = 64;
/// Volume of a box widened by a ball: Steiner's formula for its parallel body.
pub(super) fn widened_volume(bounds: &Box3, r: f64) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|axis| f64::from(bounds.1[axis]) - f64::from(bounds.0[axis]));
    a * b * c + 2.0 * r * (a * b + b * c + c * a) + PI * r * r * (a + b + c) + 4.0 / 3.0 * PI * r * r * r
}

/// Sorts the photons about the split of least expected work: its axis, number of photons on the left, and plane. `None`
/// if none is better than no split at all.
pub(super) fn best_split(points: &mut [Point], cell: &Box3, radius: f64) -> Option<(usize, usize, f32)> {
    let mut best = (points.len() as f64 * widened_volume(cell, radius), None);
    let mut consider = |axis: usize, left: usize, low: f32, high: f32| {
        // Empty space goes to the one side or to the other.
        for plane in [low, high] {
            let (mut left_cell, mut right_cell) = (*cell, *cell);
            left_cell.1[axis] = plane;
            right_cell.0[axis] = plane;
            let work = left as f64 * widened_volume(&left_cell, radius)
                + (points.len() - left) as f64 * widened_volume(&right_cell, radius);
            if work < best.0 {
                best = (work, Some((axis, left, plane)));
            }
        }
    };
    let few = points.len() <= FEW;
    let bounds = extent(points.iter().map(|point| point.position));
    for axis in 0..3 {
        if bounds.0[axis] >= bounds.1[axis] {
            continue;
        }
        if few {
            let mut coordinates: Vec<f32> = points.iter().map(|point| point.position[axis]).collect();
            coordinates.sort_unstable_by(f32::total_cmp);
            for (left, pair) in (1..).zip(coordinates.windows(2)) {
                if pair[0] < pair[1] {
                    consider(axis, left, pair[0], pair[1]);
                }
            }
            continue;
        }
        let mut bins = [(0usize, f32::INFINITY, f32::NEG_INFINITY); BINS];
        for point in &*points {
            let x = point.position[axis];
            let bin = &mut bins[bin_of(x, bounds.0[axis], bounds.1[axis])];
            *bin = (bin.0 + 1, bin.1.min(x), bin.2.max(x));
        }
        let (mut left, mut low) = (0, f32::NEG_INFINITY);
        for bin in bins.iter().filter(|bin| bin.0 > 0) {
            if left > 0 {
                consider(axis, left, low, bin.1);
            }
            left += bin.0;
            low = bin.2;
        }
    }
    let (axis, left, plane) = best.1?;
    // The photons left of the split are the `left` first along its axis, by coordinate alone.
    select_nth(points, left, axis);
    Some((axis, left, plane))
}

/// Which of the bins between two coordinates; monotone, so that counts are exact.
fn bin_of(x: f32, least: f32, greatest: f32) -> usize {
    let share = (f64::from(x) - f64::from(least)) / (f64::from(greatest) - f64::from(least));
    ((share * BINS as f64) as usize).min(BINS - 1)
}
