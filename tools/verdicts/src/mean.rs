//! The mean power of photons.

use crate::derivation::fail;
use crate::table::csv;
use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use pm_sweep::significant;

/// The mean power of photons in CSV, or as pm-view prints them.
pub(crate) const MEAN: Derivation = Derivation {
    word: "mean",
    help: "The mean power of photons in CSV, or as pm-view --records prints them",
    settings: &[],
    derive,
};

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let (mut sum, mut rows) = ([0.0; 3], 0.0);
    for row in asked.table(0)?.rows() {
        rows += 1.0;
        for (sum, name) in sum.iter_mut().zip(["power_r", "power_g", "power_b"]) {
            *sum += row.number(name)?;
        }
    }
    if rows == 0.0 {
        return fail("there are no photons");
    }
    let [r, g, b] = sum.map(|sum| significant(sum / rows, 9));
    Ok(csv(["name", "r", "g", "b"], [["mean power".to_owned(), r, g, b]]).into())
}
