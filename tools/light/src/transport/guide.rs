//! Where light comes from, by the photons: gather rays are sent there more often.
//!
//! Jensen, *Importance Driven Path Tracing Using the Photon Map*, Eurographics Workshop on Rendering 1995: the photons
//! about a point fill a coarse grid of incident directions, and rays are drawn in proportion. His nearest photons are
//! here those of the smallest cell of an octree that holds enough of them and whose surfaces face the same way, so no
//! search is made. Half of every distribution is the cosine's, so that light the photons missed is found as well, and a
//! ray carries at most twice what it would without a guide.

use super::reflection::spreads;
use super::sampling::cosine_direction;
use super::surface::Stage;
use crate::scene::MaterialKind;
use glam::Vec3;
use pm_curves::{HILBERT_BITS, hilbert_keys};
use pm_film::hemisphere::frame;
use pm_formats::{Bounds, Photon};
use std::f32::consts::PI;

#[cfg(test)]
mod tests;

/// Cells of the grid of directions: strata of squared sine and of azimuth, all of equal chance under the cosine.
const ROWS: usize = 8;
const COLUMNS: usize = 16;
/// Fewest photons that make a distribution.
const ENOUGH: usize = 400;
/// Share of each distribution that is the cosine's.
const COSINE_SHARE: f32 = 0.5;
/// Levels of the octree that are asked, finest first: cells of 1/64 to 1/4 of the scene's longest side.
const LEVELS: std::ops::RangeInclusive<u32> = 2..=6;
/// A photon's direction is packed so coarsely that it may be off by so many radians.
const PACKING: f32 = 0.008;

/// The photons of a scene, sorted so that those of any cell are neighbours.
pub(super) struct Guide {
    bounds: Bounds,
    /// Keys, ascending: the side that the surface faces above, the place along Hilbert's curve below.
    keys: Vec<u64>,
    incoming: Vec<Incoming>,
}

/// What a photon tells of where light comes from.
#[derive(Clone, Copy)]
struct Incoming {
    towards_source: Vec3,
    /// Sum of the channels of its flux.
    power: f32,
}

impl Guide {
    /// Photons that came straight from a lamp are left out: gather rays do not ask for that light.
    pub(super) fn new(stage: &Stage<'_>, photons: &[Photon]) -> Self {
        let scene_bounds = stage.scene.bounds;
        let bounds = Bounds { min: scene_bounds.min.into(), max: scene_bounds.max.into() };
        let kept: Vec<Photon> = photons.iter().filter(|photon| !sees_lamp(stage, photon)).copied().collect();
        let places = hilbert_keys(&bounds, &kept, |photon| photon.position);
        let mut sorted: Vec<(u64, Photon)> =
            places.into_iter().zip(kept).map(|(place, photon)| (key(photon.normal().into(), place), photon)).collect();
        // Stable: photons of one place stay in the order of the stream.
        sorted.sort_by_key(|&(key, _)| key);
        let incoming = |&(_, photon): &(u64, Photon)| Incoming {
            towards_source: photon.towards_source().into(),
            power: photon.power().into_iter().sum::<f64>() as f32,
        };
        Self {
            bounds,
            keys: sorted.iter().map(|&(key, _)| key).collect(),
            incoming: sorted.iter().map(incoming).collect(),
        }
    }

    /// Number of photons that guide.
    pub(super) fn len(&self) -> usize {
        self.keys.len()
    }

    /// Where light comes from at a point; `None` if too few photons are about.
    pub(super) fn at(&self, position: Vec3, normal: Vec3) -> Option<Directions> {
        // Packed and unpacked as photons' normals are: a wall between two sides is then on one side for both.
        let unit = Photon::new([0.0; 3], [1.0; 3], [0.0; 3], normal.into(), normal.into())?;
        let place = hilbert_keys(&self.bounds, &[position.to_array()], |&position| position)[0];
        let key = key(unit.normal().into(), place);
        let cell = LEVELS.rev().find_map(|level| {
            let shift = 3 * (HILBERT_BITS - level);
            let first = self.keys.partition_point(|other| other >> shift < key >> shift);
            let number = self.keys[first..].partition_point(|other| other >> shift == key >> shift);
            (number >= ENOUGH).then(|| &self.incoming[first..first + number])
        });
        Directions::new(normal, cell?.iter().map(|photon| (photon.towards_source, photon.power)))
    }
}

/// The side that a surface faces (one of six), and where it is.
fn key(normal: Vec3, place: u32) -> u64 {
    let size = normal.abs();
    let axis = if size.x >= size.y && size.x >= size.z { 0 } else { 1 + usize::from(size.z > size.y) };
    let side = 2 * axis as u64 + u64::from(normal[axis] < 0.0);
    side << (3 * HILBERT_BITS) | u64::from(place)
}

/// Does a photon come straight from a lamp that does nothing but shine?
fn sees_lamp(stage: &Stage<'_>, photon: &Photon) -> bool {
    let (normal, towards) = (Vec3::from(photon.normal()), Vec3::from(photon.towards_source()));
    let start = Vec3::from(photon.position) + normal * (1e-5 * stage.scene.bounds.size().max_element());
    let lamp = |direction: Vec3| {
        stage.hit(start, direction).is_some_and(|point| {
            let material = stage.material(&point);
            let shines = material.emits() && point.facing == point.front;
            shines && !spreads(material) && material.kind == MaterialKind::Diffuse
        })
    };
    let (x, y) = frame(towards);
    let about = [Vec3::ZERO, x, -x, y, -y];
    about.into_iter().any(|offset| lamp((towards + offset * PACKING).normalize()))
}

/// A distribution of directions over the hemisphere about a normal: constant, relative to the cosine's, in each cell of
/// a grid.
pub(super) struct Directions {
    normal: Vec3,
    /// Chance of all rows before this one, and 1 at the end.
    rows: [f32; ROWS + 1],
    /// Chance, within a row, of all columns before this one, and 1 at the end.
    columns: [[f32; COLUMNS + 1]; ROWS],
}

impl Directions {
    /// From directions towards light and its flux; `None` if there is no light on this side of the surface.
    fn new(normal: Vec3, light: impl Iterator<Item = (Vec3, f32)>) -> Option<Self> {
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
