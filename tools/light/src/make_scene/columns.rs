//! A hall: two rows of columns under arches, a barrel vault, windows along both sides, and a floor that reflects.
//!
//! Every plan length is a multiple of 0.1 m. The nave runs along z, from the wall behind the camera at z = 0; right and
//! left are mirror images in x but for the light of their windows.

use super::grid::{lines, lines_through, plane, surface};
use super::model::Model;
use glam::DVec3;
use std::f64::consts::PI;

/// Bays, and the length of each, m.
const BAYS: usize = 7;
const BAY: f64 = 3.0;
const LENGTH: f64 = BAYS as f64 * BAY;
/// The arcades: their faces towards nave and aisle, m from the middle.
const INNER: f64 = 2.2;
const OUTER: f64 = 2.8;
/// Outer walls, m from the middle.
const SIDE: f64 = 5.0;
/// Where arches begin, and where walls end and the vault begins, m.
const SPRING: f64 = 3.2;
const TOP: f64 = 5.2;
/// Radius of the arches, m.
const ARCH: f64 = 1.2;
/// Half the width of plinth, abacus and pier, m.
const HALF: f64 = (OUTER - INNER) / 2.0;
/// Window: half its width, sill and head, m.
const WINDOW: [f64; 3] = [0.6, 1.3, 3.9];
/// Radius of the lunette in the far wall, and of the lamps, m.
const LUNETTE: f64 = 1.5;
const LAMP: f64 = 0.13;

const MATERIALS: &str = "\
newmtl wall
Kd .72 .66 .56
illum 1

newmtl column
Kd .78 .74 .66
illum 1

newmtl vault
Kd .74 .72 .70
illum 1

# The tiles mirror a part and scatter a part; together they reflect less than they get.
newmtl light-tile
Kd .50 .47 .42
Ks .25 .25 .25
illum 5

newmtl dark-tile
Kd .10 .09 .08
Ks .30 .30 .30
illum 5

newmtl sun
Kd 0 0 0
Ke 5 4.2 3
illum 1

newmtl sky
Kd 0 0 0
Ke .6 .8 1.1
illum 1

newmtl lamp
Kd 0 0 0
Ke 20 16 10
illum 1
";

const CAMERA: &str = "\
# In the nave, off its middle, looking down its length.
eye = [1.1, 1.6, -0.6]
look_at = [-0.35, 2.2, -10]
up = [0, 1, 0]
vfov = 62 # degrees, vertical
size = [256, 256]
";

/// The hall with columns of four times `fineness` sides.
pub(super) fn build(fineness: u32) -> Model {
    let n = fineness.max(2) as usize;
    let mut model = Model::new(MATERIALS, CAMERA);
    model.about = vec![
        "A hall of seven bays: columns, arches, a barrel vault, windows on both sides and in the far wall, three"
            .into(),
        "lamps, and a floor of tiles that mirror a part of the light. Closed. Metres, y up, the nave along -z.".into(),
    ];
    floor(&mut model);
    for side in [-1.0, 1.0] {
        arcade(&mut model, side, n);
        aisle(&mut model, side);
    }
    columns(&mut model, n);
    vault(&mut model, n);
    for (z, lunette) in [(0.0, false), (-LENGTH, true)] {
        end_wall(&mut model, z, lunette, n);
    }
    model.group("lamps", "lamp");
    for bay in [1, 3, 5] {
        lamp(&mut model, DVec3::new(0.0, 4.2, -BAY * (f64::from(bay) + 0.5)));
    }
    model
}

/// Square tiles of 1 m.
fn floor(model: &mut Model) {
    let (across, along) = ((2.0 * SIDE) as usize, LENGTH as usize);
    for (name, parity) in [("light-tile", 0), ("dark-tile", 1)] {
        model.group(name, if parity == 0 { "light-tile" } else { "dark-tile" });
        let at = |k: usize, i: usize| DVec3::new(i as f64 - SIDE, 0.0, k as f64 - LENGTH);
        surface(model, along, across, at, |k, i| (k + i) % 2 == parity);
    }
}

/// A vertical surface whose points are (x, y, z) of both sides; on the left its winding is turned, so that the front
/// stays what it is in the mirror image.
fn mirrored(model: &mut Model, side: f64, across: usize, up: usize, at: impl Fn(usize, usize) -> DVec3) {
    let turned = |p: DVec3| DVec3::new(side * p.x, p.y, p.z);
    if side > 0.0 {
        surface(model, across, up, |i, j| turned(at(i, j)), |_, _| true);
    } else {
        surface(model, up, across, |j, i| turned(at(i, j)), |_, _| true);
    }
}

/// The wall over the columns with its arches, the piers at both ends, and the cornice.
fn arcade(model: &mut Model, side: f64, n: usize) {
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

/// Point `i` of `n` on half a circle over the origin, from +z by the top to -z, as (z, y).
fn arch_point(i: usize, n: usize, radius: f64) -> (f64, f64) {
    match i {
        0 => (radius, 0.0),
        _ if i == n => (-radius, 0.0),
        _ => {
            let (sin, cos) = libm::sincos(PI * i as f64 / n as f64);
            (radius * cos, radius * sin)
        }
    }
}

/// Outer wall with its windows, and the flat ceiling.
fn aisle(model: &mut Model, side: f64) {
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

/// Columns between the bays: plinth, base, shaft, capital, abacus.
fn columns(model: &mut Model, n: usize) {
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

/// The barrel over the nave.
fn vault(model: &mut Model, n: usize) {
    model.group("vault", "vault");
    let (arc, along) = (4 * n, 2 * BAYS * (n / 3).max(1));
    let zs = lines(0.0, -LENGTH, along);
    let at = |i: usize, k: usize| {
        let (x, y) = arch_point(i, arc, INNER);
        DVec3::new(x, TOP + y, zs[k])
    };
    surface(model, arc, along, at, |_, _| true);
}

/// A wall across the nave and both aisles, with the half-disc under the vault.
fn end_wall(model: &mut Model, z: f64, lunette: bool, n: usize) {
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
fn lamp(model: &mut Model, middle: DVec3) {
    let (rings, sides) = (10, 16);
    let at = |i: usize, k: usize| {
        let (sin, cos) = libm::sincos(PI * k as f64 / rings as f64);
        let (sin_phi, cos_phi) = libm::sincos(2.0 * PI * (i % sides) as f64 / sides as f64);
        let sin = if k == 0 || k == rings { 0.0 } else { sin };
        middle + LAMP * DVec3::new(sin * cos_phi, cos, sin * sin_phi)
    };
    surface(model, sides, rings, at, |_, _| true);
}

/// A box by its middle and half its sides, faces outward.
fn cuboid(model: &mut Model, middle: DVec3, half: DVec3) {
    for axis in 0..3 {
        let (mut n, mut u, mut v) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        (n[axis], u[(axis + 1) % 3], v[(axis + 2) % 3]) = (half[axis], half[(axis + 1) % 3], half[(axis + 2) % 3]);
        plane(model, middle + n - u - v, u * 2.0, v * 2.0, 1, 1);
        plane(model, middle - n - u - v, v * 2.0, u * 2.0, 1, 1);
    }
}
