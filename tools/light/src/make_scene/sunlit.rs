//! A room with the sun in its window, and the sky around it.
//!
//! Most of what lamps emit here never comes in, and what does comes as one bright patch on the floor, so photons are few and
//! lie together, while the rest of the room has only what the patch and the sky send on: where the same number of photons is
//! too many and too few.

use super::grid::{cells_along, cuboid, lines_through, plane, surface, wall};
use super::model::Model;
use super::recipe::{Recipe, at_least};
use glam::DVec3;
use pm_registry::registered;

registered! {
    /// A room with the sun in its window
    pub struct Sunlit = "sunlit" with [at_least("2000")];
}

/// The room, m: half its width along x, its height, and its depth along z; the window is in the wall at z = 0, the room before it.
const HALF: f64 = 2.0;
const HEIGHT: f64 = 2.6;
const DEPTH: f64 = 4.0;
/// How thick the wall around the window is.
const WALL: f64 = 0.3;
/// The window: from where to where along x, and its sill and lintel.
const ACROSS: [f64; 2] = [-0.7, 0.7];
const UP: [f64; 2] = [0.9, 2.2];
/// Middle of the sun, and half its side: it is seen under four degrees, so that shadows are sharp but not lines.
const SUN: DVec3 = DVec3::new(2.4, 5.2, -5.0);
const SUN_HALF: f64 = 0.25;
/// The sky: a sheet behind the sun, from where to where along x and y.
const SKY: [[f64; 2]; 2] = [[-6.0, 6.0], [-2.0, 9.0]];
const SKY_AT: f64 = -5.6;

const MATERIALS: &str = "\
newmtl wall
Kd .76 .74 .70
illum 1

newmtl floor
Kd .50 .36 .24
illum 1

newmtl table
Kd .30 .42 .25
illum 1

newmtl sun
Kd 0 0 0
Ke 3600 3200 2500
illum 1

newmtl sky
Kd 0 0 0
Ke 1.6 2.2 3.2
illum 1
";

const CAMERA: &str = "\
# From the back of the room, looking at the window and at what the sun paints on the floor.
eye = [1.5, 1.5, 3.6]
look_at = [-0.5, 0.8, 0.6]
up = [0, 1, 0]
vfov = 60 # degrees, vertical
size = [128, 128]
";

impl Recipe for Sunlit {
    fn build(&self, fineness: u32) -> Model {
        let cells = cells_along(fineness);
        let mut model = Model::new(MATERIALS, CAMERA);
        model.about = vec![
            "A room with one window; the sun, a square seen under four degrees, and the sky are lamps outside.".into(),
            "Closed but for the window. Metres, y up.".into(),
        ];
        shell(&mut model, cells);
        wall_with_window(&mut model, cells);
        reveal(&mut model);
        model.group("table", "table");
        cuboid(&mut model, DVec3::new(-1.1, 0.72, 1.6), DVec3::new(0.5, 0.03, 0.8));
        cuboid(&mut model, DVec3::new(-1.1, 0.345, 1.6), DVec3::new(0.08, 0.344, 0.08));
        sun(&mut model);
        model.group("sky", "sky");
        let [[left, right], [below, above]] = SKY;
        let corner = DVec3::new(left, below, SKY_AT);
        plane(&mut model, corner, DVec3::X * (right - left), DVec3::Y * (above - below), 1, 1);
        model
    }
}

/// Floor, ceiling and the three walls without a window, seen from inside.
fn shell(model: &mut Model, cells: impl Fn(f64) -> usize) {
    let (x, y, z) = (DVec3::X * (2.0 * HALF), DVec3::Y * HEIGHT, DVec3::Z * DEPTH);
    let (low, high) = (DVec3::new(-HALF, 0.0, 0.0), DVec3::new(HALF, HEIGHT, DEPTH));
    model.group("floor", "floor");
    wall(model, low, z, x, &cells);
    model.group("walls", "wall");
    wall(model, high, -x, -z, &cells);
    wall(model, high, -y, -x, &cells);
    wall(model, low, y, z, &cells);
    wall(model, high, -z, -y, &cells);
}

/// The wall around the window, from inside and from outside.
fn wall_with_window(model: &mut Model, cells: impl Fn(f64) -> usize) {
    let across = lines_through(&[-HALF, ACROSS[0], ACROSS[1], HALF], cells(2.0 * HALF));
    let up = lines_through(&[0.0, UP[0], UP[1], HEIGHT], cells(HEIGHT));
    let open = |i: usize, j: usize| (ACROSS[0]..ACROSS[1]).contains(&across[i]) && (UP[0]..UP[1]).contains(&up[j]);
    let (right, high) = (across.len() - 1, up.len() - 1);
    // x x y is z.
    surface(model, right, high, |i, j| DVec3::new(across[i], up[j], 0.0), |i, j| !open(i, j));
    surface(model, high, right, |j, i| DVec3::new(across[i], up[j], -WALL), |j, i| !open(i, j));
}

/// The inner faces of the window.
fn reveal(model: &mut Model) {
    let (x, y) = (DVec3::X * (ACROSS[1] - ACROSS[0]), DVec3::Y * (UP[1] - UP[0]));
    let z = DVec3::Z * WALL;
    let (low, high) = (DVec3::new(ACROSS[0], UP[0], -WALL), DVec3::new(ACROSS[1], UP[1], 0.0));
    plane(model, low, z, x, 1, 1);
    plane(model, low, y, z, 1, 1);
    plane(model, high, -x, -z, 1, 1);
    plane(model, high, -z, -y, 1, 1);
}

/// The sun, looking at the middle of the window.
fn sun(model: &mut Model) {
    model.group("sun", "sun");
    let window = DVec3::new(f64::midpoint(ACROSS[0], ACROSS[1]), f64::midpoint(UP[0], UP[1]), 0.0);
    let toward = (window - SUN).normalize();
    let u = toward.cross(DVec3::Y).normalize();
    let v = toward.cross(u);
    // u x v looks where the sun does: v is `toward` x u.
    let corner = SUN - (u + v) * SUN_HALF;
    plane(model, corner, u * (2.0 * SUN_HALF), v * (2.0 * SUN_HALF), 1, 1);
}
