//! A distribution of directions over a hemisphere, made of light that came from there.
//!
//! Jensen, *Importance Driven Path Tracing Using the Photon Map*, Eurographics Workshop on Rendering 1995: the photons
//! about a point fill a coarse grid of incident directions, and rays are drawn in proportion. Half of every distribution
//! is the cosine's, so that light the photons missed is found as well, and a ray carries at most twice what it would
//! without a guide.

use super::sampling::cosine_direction;
use glam::Vec3;
use pm_film::hemisphere::frame;
use std::f32::consts::PI;

#[cfg(test)]
pub(super) mod tests;

/// Cells of the grid of directions: strata of squared sine and of azimuth, all of equal chance under the cosine.
const ROWS: usize = 8;
const COLUMNS: usize = 16;
/// Share of each distribution that is the cosine's.
const COSINE_SHARE: f32 = 0.5;

/// A distribution of directions over the hemisphere about a normal: constant, relative to the cosine's, in each cell of
/// a grid.
pub(super) struct Directions {
    pub(super) normal: Vec3,
    /// Chance of all rows before this one, and 1 at the end.
    rows: [f32; ROWS + 1],
    /// Chance, within a row, of all columns before this one, and 1 at the end.
    columns: [[f32; COLUMNS + 1]; ROWS],
}

impl Directions {
    /// From directions towards light and its flux; `None` if there is no light on this side of the surface.
    pub(super) fn new(normal: Vec3, light: impl Iterator<Item = (Vec3, f32)>) -> Option<Self> {
        let mut flux = [[0f32; COLUMNS]; ROWS];
        let mut total = 0.0;
        for (direction, power) in light.filter(|(direction, _)| direction.dot(normal) > 0.0) {
            // Shared out among the four nearest cells: as smooth as cells twice as wide, and less blocky.
            let (u, v) = unit_square(normal, direction);
            let (row, below) = neighbours(u * ROWS as f32, |row| row.clamp(0, ROWS as i32 - 1));
            let (column, right) = neighbours(v * COLUMNS as f32, |column| column.rem_euclid(COLUMNS as i32));
            for (row, row_share) in row.into_iter().zip([1.0 - below, below]) {
                for (column, column_share) in column.into_iter().zip([1.0 - right, right]) {
                    flux[row][column] += power * row_share * column_share;
                }
            }
            total += power;
        }
        if total.is_nan() || total <= 0.0 || total.is_infinite() {
            return None;
        }
        let even = COSINE_SHARE / (ROWS * COLUMNS) as f32;
        let chances = flux.map(|row| row.map(|flux| even + (1.0 - COSINE_SHARE) * (flux / total)));
        let columns = chances.map(|row| cumulative(&row));
        let rows = cumulative(&chances.map(|row| row.iter().sum()));
        Some(Self { normal, rows, columns })
    }

    /// The direction for `u` and `v` in [0, 1), and its density relative to the cosine's. Strata of `u` and `v` stay
    /// strata: both are stretched, never folded.
    pub(super) fn sample(&self, u: f32, v: f32) -> (Vec3, f32) {
        let (row, u, row_density) = stretched(&self.rows, u);
        let (_, v, column_density) = stretched(&self.columns[row], v);
        (cosine_direction(self.normal, u, v), row_density * column_density)
    }

    /// The density of a direction above the surface, relative to the cosine's.
    pub(super) fn density(&self, direction: Vec3) -> f32 {
        let (u, v) = unit_square(self.normal, direction);
        let row = ((u * ROWS as f32) as usize).min(ROWS - 1);
        let column = ((v * COLUMNS as f32) as usize).min(COLUMNS - 1);
        chance(&self.rows, row) * chance(&self.columns[row], column) * (ROWS * COLUMNS) as f32
    }
}

/// Squared sine of the elevation from the normal, and azimuth as a share of a turn: what
/// [`cosine_direction`](super::sampling::cosine_direction) makes directions of.
fn unit_square(normal: Vec3, direction: Vec3) -> (f32, f32) {
    let (x, y) = frame(normal);
    let cosine = direction.dot(normal);
    let turn = libm::atan2f(direction.dot(y), direction.dot(x)) / (2.0 * PI);
    ((1.0 - cosine * cosine).clamp(0.0, 1.0), if turn < 0.0 { turn + 1.0 } else { turn })
}

/// The two cells whose middles are before and behind a place, and the share of the second.
fn neighbours(place: f32, wrap: impl Fn(i32) -> i32) -> ([usize; 2], f32) {
    let before = (place - 0.5).floor();
    let cell = before as i32;
    ([wrap(cell) as usize, wrap(cell + 1) as usize], place - 0.5 - before)
}

/// Chances as shares of their sum, added up.
fn cumulative<const N: usize, const M: usize>(chances: &[f32; N]) -> [f32; M] {
    let total: f32 = chances.iter().sum();
    let mut sum = 0.0;
    let mut sums = [0.0; M];
    for (at, chance) in sums[1..].iter_mut().zip(chances) {
        sum += chance;
        *at = sum / total;
    }
    sums[N] = 1.0;
    sums
}

fn chance(sums: &[f32], cell: usize) -> f32 {
    sums[cell + 1] - sums[cell]
}

/// The inverse of a distribution function: cell, place in [0, 1], density.
fn stretched(sums: &[f32], x: f32) -> (usize, f32, f32) {
    let cells = sums.len() - 1;
    let cell = sums[1..cells].partition_point(|&sum| sum <= x);
    let chance = chance(sums, cell);
    let within = ((x - sums[cell]) / chance).clamp(0.0, 1.0);
    (cell, ((cell as f32 + within) / cells as f32).min(1.0), chance * cells as f32)
}
