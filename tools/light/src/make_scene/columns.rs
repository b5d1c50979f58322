//! A hall: two rows of columns under arches, a barrel vault, windows along both sides, and a floor that reflects.
//!
//! Every plan length is a multiple of 0.1 m. The nave runs along z, from the wall behind the camera at z = 0; right and
//! left are mirror images in x but for the light of their windows.

mod column;
mod nave;
mod plan;
mod walls;

use super::model::Model;
use super::recipe::{Recipe, at_least};
use column::columns;
use glam::DVec3;
use nave::{arcade, floor, vault};
use plan::{BAY, LENGTH};
use pm_registry::registered;
use walls::{aisle, end_wall, lamp};

registered! {
    /// A hall with columns, arches, a vault, windows and a reflecting floor
    pub struct Columns = "columns" with [at_least("60000")];
}

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

impl Recipe for Columns {
    /// Columns have four times `fineness` sides.
    fn build(&self, fineness: u32) -> Model {
        let n = fineness.max(2) as usize;
        let mut model = Model::new(MATERIALS, CAMERA);
        model.about = vec![
            "A hall of seven bays: columns, arches, a barrel vault, windows on both sides and in the far wall, three"
                .into(),
            "lamps, and a floor of tiles that mirror a part of the light. Closed. Metres, y up, the nave along -z."
                .into(),
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
}
