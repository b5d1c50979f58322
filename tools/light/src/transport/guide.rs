//! Where light comes from, by the photons: gather rays are sent there more often.
//!
//! Jensen, *Importance Driven Path Tracing Using the Photon Map*, Eurographics Workshop on Rendering 1995. His nearest
//! photons are here those of the smallest cell of an octree that holds enough of them and whose surfaces face the same
//! way, so no search is made.

use super::directions::Directions;
use super::scatter::spreads;
use super::surface::Surfaces;
use crate::scene::MaterialKind;
use glam::Vec3;
use pm_curves::{HILBERT_BITS, hilbert_keys};
use pm_film::hemisphere::frame;
use pm_formats::{Bounds, Photon};

#[cfg(test)]
mod tests;

/// Photons that make a distribution where there are many, and the fewest that do.
const ENOUGH: usize = 400;
pub(super) const FEWEST: usize = 16;
/// Levels of the octree that are asked, finest first: cells of 1/64 to 1/4 of the scene's longest side.
const LEVELS: std::ops::RangeInclusive<u32> = 2..=6;
/// A photon's direction is packed so coarsely that it may be off by so many radians.
const PACKING: f32 = 0.008;

/// The photons of a scene, sorted so that those of any cell are neighbours.
pub(super) struct Guide {
    bounds: Bounds,
    /// Photons that a cell has to have: fewer where even the fullest of the largest cells has not many.
    enough: usize,
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
    pub(super) fn new(surfaces: &Surfaces<'_>, photons: &[Photon]) -> Self {
        let scene_bounds = surfaces.scene.bounds;
        let bounds = Bounds { min: scene_bounds.min.into(), max: scene_bounds.max.into() };
        let kept: Vec<Photon> = photons.iter().filter(|photon| !sees_lamp(surfaces, photon)).copied().collect();
        let places = hilbert_keys(&bounds, &kept, |photon| photon.position);
        let mut sorted: Vec<(u64, Photon)> =
            places.into_iter().zip(kept).map(|(place, photon)| (key(photon.normal().into(), place), photon)).collect();
        // Stable: photons of one place stay in the order of the stream.
        sorted.sort_by_key(|&(key, _)| key);
        let incoming = |&(_, photon): &(u64, Photon)| Incoming {
            towards_source: photon.towards_source().into(),
            power: photon.power().into_iter().sum::<f64>() as f32,
        };
        let keys: Vec<u64> = sorted.iter().map(|&(key, _)| key).collect();
        Self {
            bounds,
            enough: (fullest(&keys) / 4).clamp(FEWEST, ENOUGH),
            keys,
            incoming: sorted.iter().map(incoming).collect(),
        }
    }

    /// Number of photons that guide.
    pub(super) fn len(&self) -> usize {
        self.keys.len()
    }

    /// Is there a cell, of the coarsest, that holds enough of them?
    pub(super) fn guides_somewhere(&self) -> bool {
        fullest(&self.keys) >= self.enough
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
            (number >= self.enough).then(|| &self.incoming[first..first + number])
        });
        Directions::new(normal, cell?.iter().map(|photon| (photon.towards_source, photon.power)))
    }
}

/// Photons of the fullest of the largest cells.
fn fullest(keys: &[u64]) -> usize {
    let shift = 3 * (HILBERT_BITS - LEVELS.start());
    keys.chunk_by(|a, b| a >> shift == b >> shift).map(<[u64]>::len).max().unwrap_or(0)
}

/// The side that a surface faces (one of six), and where it is.
fn key(normal: Vec3, place: u32) -> u64 {
    let size = normal.abs();
    let axis = if size.x >= size.y && size.x >= size.z { 0 } else { 1 + usize::from(size.z > size.y) };
    let side = 2 * axis as u64 + u64::from(normal[axis] < 0.0);
    side << (3 * HILBERT_BITS) | u64::from(place)
}

/// Does a photon come straight from a lamp that does nothing but shine?
fn sees_lamp(surfaces: &Surfaces<'_>, photon: &Photon) -> bool {
    let (normal, towards) = (Vec3::from(photon.normal()), Vec3::from(photon.towards_source()));
    let start = Vec3::from(photon.position) + normal * (1e-5 * surfaces.scene.bounds.size().max_element());
    let lamp = |direction: Vec3| {
        surfaces.hit(start, direction).is_some_and(|point| {
            let material = surfaces.material(&point);
            let shines = material.emits() && point.facing == point.front;
            shines && !spreads(material) && material.kind == MaterialKind::Diffuse
        })
    };
    let (x, y) = frame(towards);
    let about = [Vec3::ZERO, x, -x, y, -y];
    about.into_iter().any(|offset| lamp((towards + offset * PACKING).normalize()))
}
