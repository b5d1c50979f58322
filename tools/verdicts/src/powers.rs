//! Photons with random powers, to import.

use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use pm_sweep::significant;
use std::fmt::Write as _;

/// A million photons with random powers, as CSV.
pub(crate) const POWERS: Derivation = Derivation {
    word: "powers",
    help: "A million photons with random powers over six orders of magnitude, as CSV",
    settings: &["photons"],
    derive,
};

/// Park and Miller's generator, which needs no more than exact integers below 2^47, so that whoever makes these numbers
/// makes the same: Communications of the ACM 31, 1988, with the multiplier 48271 of their second thoughts.
struct ParkMiller(u64);

impl ParkMiller {
    const MODULUS: u64 = 2_147_483_647;

    fn next(&mut self) -> f64 {
        self.0 = self.0 * 48_271 % Self::MODULUS;
        self.0 as f64 / Self::MODULUS as f64
    }
}

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let photons = asked.setting("photons")?.unwrap_or(1_000_000);
    let mut random = ParkMiller(20_051);
    let mut text = "x,y,z,power_r,power_g,power_b\n".to_owned();
    for _ in 0..photons {
        // Six orders of magnitude, and channels that do not resemble one another.
        let scale = ((6.0 * random.next() - 3.0) * 10.0_f64.ln()).exp();
        let [x, y, z] = [random.next(), random.next(), random.next()];
        let _ = write!(text, "{x:.6},{y:.6},{z:.6}");
        for _ in 0..3 {
            let _ = write!(text, ",{}", significant(scale * random.next(), 9));
        }
        text += "\n";
    }
    Ok(text.into())
}
