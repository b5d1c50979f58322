//! Points in a plane, to import.

use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use pm_sweep::significant;
use std::fmt::Write as _;

/// A square of the unit plane full of points, as CSV.
pub(crate) const LATTICE: Derivation = Derivation {
    word: "lattice",
    help: "So many points along a `side` of the unit square, and across, at a `height`, as CSV",
    settings: &["side", "height"],
    derive,
};

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let (side, height) = (asked.needed::<u32>("side")?, asked.needed::<f64>("height")?);
    let number = |x: f64| significant(x, 6);
    let at = |i: u32| number(f64::from(i) / f64::from(side));
    let mut text = "x,y,z\n".to_owned();
    for z in 0..side {
        for x in 0..side {
            let _ = writeln!(text, "{},{},{}", at(x), number(height), at(z));
        }
    }
    Ok(text.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::derived;

    #[test]
    fn a_square_of_points() {
        let text = derived(&LATTICE, &[], &[("side", "3"), ("height", "1")]).unwrap().text;
        let expected = "x,y,z\n0,1,0\n0.333333,1,0\n0.666667,1,0\n0,1,0.333333\n0.333333,1,0.333333\n";
        assert!(text.starts_with(expected) && text.lines().count() == 10, "{text}");
    }
}
