//! Outer walls and their windows, end walls, lamps.

use super::plan::{BAY, BAYS, INNER, LAMP, LENGTH, LUNETTE, OUTER, SIDE, TOP, WINDOW, arch_point};
use crate::make_scene::grid::{lines_through, plane, surface};
use crate::make_scene::model::Model;
use glam::DVec3;
use std::f64::consts::PI;

/// Outer wall with its windows, and the flat ceiling.
pub(super) fn aisle(model: &mut Model, side: f64) {
    let [half, sill, head] = WINDOW;
    let mut stops = vec![-LENGTH];
    for bay in (0..BAYS).rev() {
        let middle = -BAY * (bay as f64 + 0.5);
        stops.extend([middle - half, middle + half]);
    }
    stops.push(0.0);
    let zs = lines_through(&stops, 10 * BAYS);
    let ys = lines_through(&[0.0, sill, head, TOP], 20);
    let is_window = |j: usize, k: usize| {
        let (y, z) = ((ys[j] + ys[j + 1]) / 2.0, (zs[k] + zs[k + 1]) / 2.0);
        let from_middle = (z / BAY).rem_euclid(1.0) - 0.5;
        (sill..head).contains(&y) && from_middle.abs() * BAY < half
    };
    let at = |j: usize, k: usize| DVec3::new(side * SIDE, ys[j], zs[k]);
    for (name, material, windows) in
        [("outer-wall", "wall", false), ("windows", if side < 0.0 { "sun" } else { "sky" }, true)]
    {
        model.group(name, material);
        // y x z is +x, the inside of the left wall.
        if side < 0.0 {
            surface(model, ys.len() - 1, zs.len() - 1, at, |j, k| is_window(j, k) == windows);
        } else {
            surface(model, zs.len() - 1, ys.len() - 1, |k, j| at(j, k), |k, j| is_window(j, k) == windows);
        }
    }
    model.group("aisle-ceiling", "vault");
    let from = if side < 0.0 { -SIDE } else { OUTER };
    let corner = DVec3::new(from, TOP, -LENGTH);
    plane(model, corner, DVec3::X * (SIDE - OUTER), DVec3::Z * LENGTH, 3, 10 * BAYS);
}

/// A wall across the nave and both aisles, with the half-disc under the vault.
pub(super) fn end_wall(model: &mut Model, z: f64, lunette: bool, n: usize) {
    model.group("end-wall", "wall");
    let (corner, across) = if lunette { (-SIDE, DVec3::X) } else { (SIDE, DVec3::NEG_X) };
    plane(model, DVec3::new(corner, 0.0, z), across * (2.0 * SIDE), DVec3::Y * TOP, 20, 10);
    let arc = 4 * n;
    for (material, inner, outer) in [(if lunette { "sky" } else { "wall" }, 0.0, LUNETTE), ("wall", LUNETTE, INNER)] {
        model.group("lunette", material);
        let at = |i: usize, j: usize| {
            let (x, y) = arch_point(i, arc, if j == 0 { inner } else { outer });
            DVec3::new(x, TOP + y, z)
        };
        if lunette {
            surface(model, 1, arc, |j, i| at(i, j), |_, _| true);
        } else {
            surface(model, arc, 1, at, |_, _| true);
        }
    }
}

/// A sphere that shines outward.
pub(super) fn lamp(model: &mut Model, middle: DVec3) {
    let (rings, sides) = (10, 16);
    let at = |i: usize, k: usize| {
        let (sin, cos) = libm::sincos(PI * k as f64 / rings as f64);
        let (sin_phi, cos_phi) = libm::sincos(2.0 * PI * (i % sides) as f64 / sides as f64);
        let sin = if k == 0 || k == rings { 0.0 } else { sin };
        middle + LAMP * DVec3::new(sin * cos_phi, cos, sin * sin_phi)
    };
    surface(model, sides, rings, at, |_, _| true);
}
