//! Floor, arcades and vault.

use super::plan::{ARCH, BAY, BAYS, HALF, INNER, LENGTH, OUTER, SIDE, SPRING, TOP, arch_point, mirrored};
use crate::make_scene::grid::{cuboid, lines, surface};
use crate::make_scene::model::Model;
use glam::DVec3;

/// Square tiles of 1 m.
pub(super) fn floor(model: &mut Model) {
    let (across, along) = ((2.0 * SIDE) as usize, LENGTH as usize);
    for (name, parity) in [("light-tile", 0), ("dark-tile", 1)] {
        model.group(name, if parity == 0 { "light-tile" } else { "dark-tile" });
        let at = |k: usize, i: usize| DVec3::new(i as f64 - SIDE, 0.0, k as f64 - LENGTH);
        surface(model, along, across, at, |k, i| (k + i) % 2 == parity);
    }
}

/// The wall over the columns with its arches, the piers at both ends, and the cornice.
pub(super) fn arcade(model: &mut Model, side: f64, n: usize) {
    model.group("arcade", "wall");
    let arc = 2 * n;
    for bay in 0..BAYS {
        let middle = -BAY * (bay as f64 + 0.5);
        // The lower edge of the wall, towards -z: half an abacus, the arch, half an abacus.
        let lower: Vec<(f64, f64)> = std::iter::once((BAY / 2.0, 0.0))
            .chain((0..=arc).map(|i| arch_point(i, arc, ARCH)))
            .chain([(-BAY / 2.0, 0.0)])
            .map(|(z, y)| (middle + z, SPRING + y))
            .collect();
        let last = lower.len() - 1;
        let rows = (n / 3).max(1);
        let face = |x: f64, i: usize, j: usize| {
            let (z, y) = lower[i];
            DVec3::new(x, if j == rows { TOP } else { y + (TOP - y) * (j as f64 / rows as f64) }, z)
        };
        // Upward x along is -x, towards the nave on the right; along x upward is +x, towards the aisle.
        mirrored(model, side, rows, last, |j, i| face(INNER, i, j));
        mirrored(model, side, last, rows, |i, j| face(OUTER, i, j));
        let soffit = |i: usize, j: usize| {
            let (z, y) = lower[i + 1];
            DVec3::new(if j == 0 { INNER } else { OUTER }, y, z)
        };
        mirrored(model, side, arc, 1, soffit);
    }
    let middle = side * (INNER + HALF);
    for z in [-HALF / 2.0, -LENGTH + HALF / 2.0] {
        cuboid(model, DVec3::new(middle, SPRING / 2.0, z), DVec3::new(HALF, SPRING / 2.0, HALF / 2.0));
    }
    model.group("cornice", "column");
    cuboid(model, DVec3::new(side * (INNER - 0.075), TOP - 0.1, -LENGTH / 2.0), DVec3::new(0.075, 0.1, LENGTH / 2.0));
}

/// The barrel over the nave.
pub(super) fn vault(model: &mut Model, n: usize) {
    model.group("vault", "vault");
    let (arc, along) = (4 * n, 2 * BAYS * (n / 3).max(1));
    let zs = lines(0.0, -LENGTH, along);
    let at = |i: usize, k: usize| {
        let (x, y) = arch_point(i, arc, INNER);
        DVec3::new(x, TOP + y, zs[k])
    };
    surface(model, arc, along, at, |_, _| true);
}
