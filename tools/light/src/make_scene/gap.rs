//! A dark room beside a lit one: all its light comes through the gap of 5 cm that a sliding door leaves.
//!
//! What the gap lets through is a hundredth of the lamp's light, so next to no photon of a map is in the room that the
//! camera sees, and nearly all its light has been reflected more than once: what photon maps and path tracers find hardest.

use super::grid::{cells_along, cuboid, lines_through, plane, surface, wall};
use super::model::Model;
use super::recipe::{Recipe, at_least};
use glam::DVec3;
use pm_registry::registered;

registered! {
    /// A dark room lit through the 5 cm gap of a door
    pub struct Gap = "gap" with [at_least("2000")];
}

/// Both rooms, m: length of each along x, height, and half the width along z.
const LENGTH: f64 = 3.0;
const HEIGHT: f64 = 2.5;
const HALF: f64 = 1.5;
/// The wall between them stands at x = -WALL to 0, the dark room beyond it.
const WALL: f64 = 0.12;
/// The doorway: from -SIDE to SIDE along z, and its height.
const SIDE: f64 = 0.45;
const DOORWAY: f64 = 2.05;
/// What the door leaves open at its side, and how thick it is. It stands in the wall a little, so that nothing else is open.
const GAP: f64 = 0.05;
const THICKNESS: f64 = 0.04;
const SUNK: f64 = 0.005;
/// Half the side of the lamp, and how far it hangs below the ceiling.
const LAMP: f64 = 0.25;
const BELOW: f64 = 0.01;

const MATERIALS: &str = "\
newmtl wall
Kd .74 .72 .68
illum 1

newmtl floor
Kd .55 .45 .35
illum 1

newmtl door
Kd .35 .48 .60
illum 1

newmtl chest
Kd .60 .25 .15
illum 1

newmtl lamp
Kd 0 0 0
Ke 1200 1050 800
illum 1
";

const CAMERA: &str = "\
# In the dark room, looking at the door.
eye = [2.8, 1.5, -1.2]
look_at = [0.3, 0.75, 0.45]
up = [0, 1, 0]
vfov = 65 # degrees, vertical
size = [128, 128]
";

impl Recipe for Gap {
    fn build(&self, fineness: u32) -> Model {
        let cells = cells_along(fineness);
        let mut model = Model::new(MATERIALS, CAMERA);
        model.about = vec![
            "Two rooms and a sliding door between them that leaves 5 cm open; the lamp is in the other one.".into(),
            "Closed. Metres, y up.".into(),
        ];
        shell(&mut model, cells);
        for (x, front) in [(0.0, 1.0), (-WALL, -1.0)] {
            wall_between(&mut model, x, front, cells);
        }
        reveal(&mut model);
        model.group("door", "door");
        let (from, to) = (DVec3::new(-SUNK, -SUNK, -SIDE - 0.1), DVec3::new(THICKNESS, DOORWAY + 0.1, SIDE - GAP));
        cuboid(&mut model, (from + to) / 2.0, (to - from) / 2.0);
        model.group("chest", "chest");
        cuboid(&mut model, DVec3::new(0.45, 0.2495, -1.0), DVec3::new(0.3, 0.25, 0.4));
        model.group("lamp", "lamp");
        let corner = DVec3::new(-WALL - LENGTH / 2.0 - LAMP, HEIGHT - BELOW, -LAMP);
        plane(&mut model, corner, DVec3::X * (2.0 * LAMP), DVec3::Z * (2.0 * LAMP), 1, 1);
        model
    }
}

/// Floor, ceiling and outer walls of both rooms together, seen from inside.
fn shell(model: &mut Model, cells: impl Fn(f64) -> usize) {
    let (from, to) = (-WALL - LENGTH, LENGTH);
    let (x, y, z) = (DVec3::X * (to - from), DVec3::Y * HEIGHT, DVec3::Z * (2.0 * HALF));
    let (low, high) = (DVec3::new(from, 0.0, -HALF), DVec3::new(to, HEIGHT, HALF));
    model.group("floor", "floor");
    wall(model, low, z, x, &cells);
    model.group("walls", "wall");
    wall(model, high, -x, -z, &cells);
    wall(model, low, x, y, &cells);
    wall(model, high, -y, -x, &cells);
    wall(model, low, y, z, &cells);
    wall(model, high, -z, -y, &cells);
}

/// One face of the wall between the rooms, around the doorway; its front looks along x times `front`.
fn wall_between(model: &mut Model, x: f64, front: f64, cells: impl Fn(f64) -> usize) {
    let across = lines_through(&[-HALF, -SIDE, SIDE, HALF], cells(2.0 * HALF));
    let up = lines_through(&[0.0, DOORWAY, HEIGHT], cells(HEIGHT));
    let wall = |i: usize, j: usize| up[j] >= DOORWAY || across[i] < -SIDE || across[i] >= SIDE;
    // y x z is x.
    if front > 0.0 {
        surface(model, up.len() - 1, across.len() - 1, |j, i| DVec3::new(x, up[j], across[i]), |j, i| wall(i, j));
    } else {
        surface(model, across.len() - 1, up.len() - 1, |i, j| DVec3::new(x, up[j], across[i]), wall);
    }
}

/// The inner faces of the doorway.
fn reveal(model: &mut Model) {
    let (x, y, z) = (DVec3::X * WALL, DVec3::Y * DOORWAY, DVec3::Z * (2.0 * SIDE));
    let (low, high) = (DVec3::new(-WALL, 0.0, -SIDE), DVec3::new(0.0, DOORWAY, SIDE));
    plane(model, low, x, y, 1, 1);
    plane(model, high, -y, -x, 1, 1);
    plane(model, high, -x, -z, 1, 1);
}
