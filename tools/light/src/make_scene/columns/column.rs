//! The columns: plinth, base, shaft, capital, abacus.

use super::plan::{BAY, BAYS, HALF, INNER, SPRING};
use crate::make_scene::grid::{cuboid, lines};
use crate::make_scene::model::Model;
use glam::DVec3;
use std::f64::consts::PI;

/// Columns between the bays: plinth, base, shaft, capital, abacus.
pub(super) fn columns(model: &mut Model, n: usize) {
    let profile = profile(n);
    let sides = 4 * n;
    for bay in 1..BAYS {
        for side in [-1.0, 1.0] {
            let foot = DVec3::new(side * (INNER + HALF), 0.0, -BAY * bay as f64);
            model.group("column", "column");
            for (low, high) in [(0.0, 0.2), (3.0, SPRING)] {
                let middle = foot + DVec3::Y * f64::midpoint(low, high);
                cuboid(model, middle, DVec3::new(HALF, (high - low) / 2.0, HALF));
            }
            turned(model, foot, &profile, sides);
        }
    }
}

/// Radius and height along a column, from the plinth up, m.
fn profile(n: usize) -> Vec<(f64, f64)> {
    let round = (n / 2).max(2);
    let mut out = vec![];
    // Torus: half a circle, flattened.
    for i in 0..=round {
        let (sin, cos) = libm::sincos(PI * i as f64 / round as f64);
        out.push((0.25 + 0.045 * sin, 0.28 - 0.08 * cos));
    }
    out.push((0.25, 0.40));
    // Shaft: straight below, drawn in towards the top.
    for t in lines(0.0, 1.0, n) {
        out.push((0.24 - 0.045 * t * t, 0.42 + 2.24 * t));
    }
    out.extend([(0.22, 2.68), (0.22, 2.74), (0.195, 2.76)]);
    // Echinus: widens to the abacus.
    for t in &lines(0.0, 1.0, round)[1..] {
        out.push((0.195 + 0.095 * t * t, 2.76 + 0.24 * t));
    }
    out
}

/// A surface of revolution about the vertical through `foot`, smooth where its profile bends gently.
fn turned(model: &mut Model, foot: DVec3, profile: &[(f64, f64)], sides: usize) {
    let around: Vec<(f64, f64)> = (0..sides).map(|i| libm::sincos(2.0 * PI * i as f64 / sides as f64)).collect();
    let rings: Vec<Vec<u32>> = profile
        .iter()
        .map(|&(r, y)| around.iter().map(|&(sin, cos)| model.point(foot + DVec3::new(r * cos, y, r * sin))).collect())
        .collect();
    for (k, pair) in profile.windows(2).enumerate() {
        let (dr, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        // One normal per band: the bands are narrow where the profile bends.
        let normals: Vec<u32> =
            around.iter().map(|&(sin, cos)| model.normal(DVec3::new(dy * cos, -dr, dy * sin))).collect();
        for i in 0..sides {
            let j = (i + 1) % sides;
            let [a, b, c, d] = [rings[k][i], rings[k + 1][i], rings[k + 1][j], rings[k][j]];
            model.smooth_triangle([a, b, c], [normals[i], normals[i], normals[j]]);
            model.smooth_triangle([a, c, d], [normals[i], normals[j], normals[j]]);
        }
    }
}
