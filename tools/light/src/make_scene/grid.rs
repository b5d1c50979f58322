//! Surfaces as grids of points: between lines along two directions, cut into triangles.

use super::model::Model;
use glam::DVec3;

/// A grid of `across` x `up` cells whose point (i, j) is `at(i, j)`; the front is on the side of (across x up). Cells for
/// which `keep` says no are left open.
pub(super) fn surface(
    model: &mut Model,
    across: usize,
    up: usize,
    at: impl Fn(usize, usize) -> DVec3,
    keep: impl Fn(usize, usize) -> bool,
) {
    let mut numbers = Vec::with_capacity((across + 1) * (up + 1));
    for j in 0..=up {
        for i in 0..=across {
            numbers.push(model.point(at(i, j)));
        }
    }
    let number = |i: usize, j: usize| numbers[j * (across + 1) + i];
    for j in 0..up {
        for i in 0..across {
            if keep(i, j) {
                model.quad([number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]);
            }
        }
    }
}

/// The parallelogram from `corner` along `u` and `v`, in `across` x `up` cells; its front is on the side of u x v.
pub(super) fn plane(model: &mut Model, corner: DVec3, u: DVec3, v: DVec3, across: usize, up: usize) {
    let at = |i: usize, j: usize| corner + u * (i as f64 / across as f64) + v * (j as f64 / up as f64);
    surface(model, across, up, at, |_, _| true);
}

/// How many cells a wall of some length has: one for each quarter of a metre and step of fineness, more or less.
pub(super) fn cells_along(fineness: u32) -> impl Fn(f64) -> usize + Copy {
    move |length| ((length * f64::from(fineness) / 4.0).round() as usize).max(1)
}

/// The parallelogram from `corner` along `u` and `v`, cut into `cells` of both lengths; its front is on the side of u x v.
pub(super) fn wall(model: &mut Model, corner: DVec3, u: DVec3, v: DVec3, cells: impl Fn(f64) -> usize) {
    plane(model, corner, u, v, cells(u.length()), cells(v.length()));
}

/// Numbers that cut [from, to] into `cells` equal parts, ends exact.
pub(super) fn lines(from: f64, to: f64, cells: usize) -> Vec<f64> {
    (0..=cells).map(|i| if i == cells { to } else { from + (to - from) * (i as f64 / cells as f64) }).collect()
}

/// Numbers that cut the intervals between `stops` into about `cells` parts in all, each stop being among them.
pub(super) fn lines_through(stops: &[f64], cells: usize) -> Vec<f64> {
    let length = stops[stops.len() - 1] - stops[0];
    let mut out = vec![stops[0]];
    for pair in stops.windows(2) {
        let share = (cells as f64 * (pair[1] - pair[0]) / length).round().max(1.0);
        out.extend_from_slice(&lines(pair[0], pair[1], share as usize)[1..]);
    }
    out
}

/// A box by its middle and half its sides, faces outward.
pub(super) fn cuboid(model: &mut Model, middle: DVec3, half: DVec3) {
    for axis in 0..3 {
        let (mut n, mut u, mut v) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        (n[axis], u[(axis + 1) % 3], v[(axis + 2) % 3]) = (half[axis], half[(axis + 1) % 3], half[(axis + 2) % 3]);
        plane(model, middle + n - u - v, u * 2.0, v * 2.0, 1, 1);
        plane(model, middle - n - u - v, v * 2.0, u * 2.0, 1, 1);
    }
}
