//! The measures of the hall, and what its parts share.

use crate::make_scene::grid::surface;
use crate::make_scene::model::Model;
use glam::DVec3;
use std::f64::consts::PI;

/// Bays, and the length of each, m.
pub(super) const BAYS: usize = 7;
pub(super) const BAY: f64 = 3.0;
pub(super) const LENGTH: f64 = BAYS as f64 * BAY;
/// The arcades: their faces towards nave and aisle, m from the middle.
pub(super) const INNER: f64 = 2.2;
pub(super) const OUTER: f64 = 2.8;
/// Outer walls, m from the middle.
pub(super) const SIDE: f64 = 5.0;
/// Where arches begin, and where walls end and the vault begins, m.
pub(super) const SPRING: f64 = 3.2;
pub(super) const TOP: f64 = 5.2;
/// Radius of the arches, m.
pub(super) const ARCH: f64 = 1.2;
/// Half the width of plinth, abacus and pier, m.
pub(super) const HALF: f64 = (OUTER - INNER) / 2.0;
/// Window: half its width, sill and head, m.
pub(super) const WINDOW: [f64; 3] = [0.6, 1.3, 3.9];
/// Radius of the lunette in the far wall, and of the lamps, m.
pub(super) const LUNETTE: f64 = 1.5;
pub(super) const LAMP: f64 = 0.13;

/// A vertical surface whose points are (x, y, z) of both sides; on the left its winding is turned, so that the front
/// stays what it is in the mirror image.
pub(super) fn mirrored(model: &mut Model, side: f64, across: usize, up: usize, at: impl Fn(usize, usize) -> DVec3) {
    let turned = |p: DVec3| DVec3::new(side * p.x, p.y, p.z);
    if side > 0.0 {
        surface(model, across, up, |i, j| turned(at(i, j)), |_, _| true);
    } else {
        surface(model, up, across, |j, i| turned(at(i, j)), |_, _| true);
    }
}

/// Point `i` of `n` on half a circle over the origin, from +z by the top to -z, as (z, y).
pub(super) fn arch_point(i: usize, n: usize, radius: f64) -> (f64, f64) {
    match i {
        0 => (radius, 0.0),
        _ if i == n => (-radius, 0.0),
        _ => {
            let (sin, cos) = libm::sincos(PI * i as f64 / n as f64);
            (radius * cos, radius * sin)
        }
    }
}
