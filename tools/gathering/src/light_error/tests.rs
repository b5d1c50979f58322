//! Is the error of light what it is by hand?

use super::*;

#[test]
fn errors_by_hand() {
    let mut error = LightError::default();
    assert!(error.rms().is_nan() && error.bias().is_nan(), "of nothing");
    error.add(Outcome::NoArea, Outcome::Radiance([0.0; 3]));
    assert!(error.rms().is_nan() && error.bias().is_nan(), "in the dark");
    error.add(Outcome::Radiance([4.0, 2.0, 0.0]), Outcome::Radiance([1.0, 2.0, 3.0]));
    // Mean 1 of six values; squares 9, 0 and 9.
    assert!((error.rms() - 3f64.sqrt()).abs() < 1e-15 && error.bias().abs() < 1e-15, "{error:?}");
    error.add(Outcome::NoArea, Outcome::Radiance([3.0, 0.0, 0.0]));
    // Six of nine: a third is lost; mean 1, squares 27.
    assert!((error.rms() - 3f64.sqrt()).abs() < 1e-15 && (error.bias() + 1.0 / 3.0).abs() < 1e-15, "{error:?}");
}
