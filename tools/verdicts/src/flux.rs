//! What arrives at the surfaces of the diffuse Cornell box.

use crate::derivation::fail;
use crate::table::csv;
use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use pm_sweep::significant;
use std::f64::consts::PI;

/// What share of the emitted flux arrives at each surface of the diffuse Cornell box, from its photons as text.
///
/// Surfaces are told by their place: `scenes/cornell-diffuse.obj` has its walls at the sides of the unit cube, and the two
/// blocks stand upright about the axes below.
pub(crate) const FLUX: Derivation = Derivation {
    word: "flux",
    help: "What share of the emitted flux arrives at each surface of the diffuse box, by photons of so many `paths`",
    settings: &["paths"],
    derive,
};

const SURFACES: [&str; 7] = ["floor", "ceiling", "left", "right", "back", "tall", "short"];
/// Area of the lamp.
const AREA: f64 = 0.25 * 0.1875;
/// Its radiance.
const RADIANCE: [f64; 3] = [18.0, 14.0, 7.0];
/// Axes of the blocks, x and z.
const TALL: [f64; 2] = [-0.16, -0.16];
const SHORT: [f64; 2] = [0.18, 0.17];

fn surface(x: f64, y: f64, z: f64) -> usize {
    let from = |axis: [f64; 2]| (x - axis[0]).powi(2) + (z - axis[1]).powi(2);
    match () {
        () if y == 0.0 => 0,
        () if y == 1.0 => 1,
        () if x == -0.5 => 2,
        () if x == 0.5 => 3,
        () if z == -0.5 => 4,
        () if from(TALL) < from(SHORT) => 5,
        () => 6,
    }
}

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let paths: f64 = asked.needed("paths")?;
    let mut flux = [[0.0; 3]; SURFACES.len()];
    let mut photons = 0;
    for row in asked.table(0)?.rows() {
        photons += 1;
        let at = surface(row.number("x")?, row.number("y")?, row.number("z")?);
        for (sum, name) in flux[at].iter_mut().zip(["power_r", "power_g", "power_b"]) {
            *sum += row.number(name)?;
        }
    }
    if photons == 0 {
        return fail("there are no photons");
    }
    let mut all = [0.0; 3];
    flux.iter().for_each(|flux| (0..3).for_each(|c| all[c] += flux[c]));
    let named = SURFACES.iter().zip(&flux).chain([(&"all", &all)]);
    let row = |(name, flux): (&&str, &[f64; 3])| {
        let share = |c: usize| significant(flux[c] / paths / (PI * AREA * RADIANCE[c]), 9);
        [(*name).to_owned(), share(0), share(1), share(2)]
    };
    Ok(csv(["name", "r", "g", "b"], named.map(row)).into())
}
