//! An integrating sphere: whatever shines on any of its wall shines on all of it alike.
//!
//! In a hollow sphere of reflectance rho the irradiance by a part of the wall that emits the flux Phi is, at every point,
//! E = Phi / (A (1 - rho)), A being the whole area (Goebel, *Generalized Integrating-Sphere Theory*, Applied Optics 6,
//! 1967). With A and Phi of the triangles it holds for the polyhedron up to the angles between them.

use super::model::Model;
use super::recipe::{Recipe, at_least};
use glam::DVec3;
use pm_registry::registered;
use std::f64::consts::PI;

registered! {
    /// An integrating sphere: the irradiance is known
    pub struct Sphere = "sphere" with [at_least("20000")];
}

/// Radius, m; the centre is (0, 0.5, 0), so that the sphere stands in the unit cube of the other scenes.
const RADIUS: f64 = 0.5;
/// Reflectance of wall and cap.
const REFLECTANCE: [f64; 3] = [0.2, 0.5, 0.8];
/// Radiance that the cap emits, W/(m² sr), all channels.
const RADIANCE: f64 = 10.0;

const MATERIALS: &str = "\
newmtl wall
Kd .2 .5 .8
illum 1

newmtl cap
Kd .2 .5 .8
Ke 10 10 10
illum 1
";

const CAMERA: &str = "\
# Inside, off the middle, looking across; the cap is overhead and out of sight.
eye = [0.1, 0.4, 0.25]
look_at = [-0.05, 0.4, -0.5]
up = [0, 1, 0]
vfov = 60 # degrees, vertical
size = [64, 64]
";

impl Recipe for Sphere {
    /// Rings of equal angle from pole to pole, six for each step of fineness, of which the first sixth is the cap: it
    /// reaches 30 degrees from the pole.
    fn build(&self, fineness: u32) -> Model {
        let sixth = fineness.div_ceil(4) as usize;
        let (rings, segments) = (6 * sixth, 12 * sixth);
        let mut model = Model::new(MATERIALS, CAMERA);
        let centre = DVec3::new(0.0, 0.5, 0.0);
        let point = |ring: usize, segment: usize| {
            let (sin, cos) = match ring {
                0 => (0.0, 1.0),
                _ if ring == rings => (0.0, -1.0),
                _ => libm::sincos(PI * ring as f64 / rings as f64),
            };
            let (sin_phi, cos_phi) = libm::sincos(2.0 * PI * segment as f64 / segments as f64);
            centre + RADIUS * DVec3::new(sin * cos_phi, cos, sin * sin_phi)
        };
        // Around is closed: the last column of points is the first one.
        let numbers: Vec<Vec<u32>> = (0..=rings)
            .map(|ring| {
                let columns = if ring == 0 || ring == rings { 1 } else { segments };
                (0..columns).map(|segment| model.point(point(ring, segment))).collect()
            })
            .collect();
        let number = |ring: usize, segment: usize| numbers[ring][segment % numbers[ring].len()];
        for (name, material, from, to) in [("cap", "cap", 0, sixth), ("wall", "wall", sixth, rings)] {
            model.group(name, material);
            for ring in from..to {
                for segment in 0..segments {
                    let (here, next) = (segment, segment + 1);
                    // Downward, then around: the front is inside.
                    model.quad([
                        number(ring, here),
                        number(ring + 1, here),
                        number(ring + 1, next),
                        number(ring, next),
                    ]);
                }
            }
        }
        let area = model.area(None);
        let flux = PI * RADIANCE * model.area(Some("cap"));
        let expected = REFLECTANCE.map(|rho| format!("{:.5}", flux / (area * (1.0 - rho)))).join(" ");
        model.about = vec![
            format!("An integrating sphere of radius {RADIUS} about 0 0.5 0, seen from inside. Metres, y up."),
            format!("Area A = {area:.6} m2, flux Phi = pi Ke A(cap) = {flux:.6} W in each channel."),
            format!("Irradiance everywhere, by Phi / (A (1 - Kd)): {expected} W/m2."),
        ];
        model
    }
}
