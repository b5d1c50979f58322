//! Are the quantiles those of the published tables?

use super::*;

#[test]
fn quantiles_are_those_of_the_published_table() {
    // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2: upper critical values, here of both sides.
    for (confidence, freedom, t) in [
        (0.95, 1.0, 12.706),
        (0.95, 2.0, 4.303),
        (0.95, 3.0, 3.182),
        (0.95, 5.0, 2.571),
        (0.95, 10.0, 2.228),
        (0.95, 30.0, 2.042),
        (0.95, 100.0, 1.984),
        (0.90, 7.0, 1.895),
        (0.99, 4.0, 4.604),
        (0.99, 60.0, 2.660),
        (0.998, 20.0, 3.552),
    ] {
        let found = student_quantile(confidence, freedom);
        assert!((found - t).abs() <= 0.0005 + 1e-9, "{confidence} {freedom}: {found} {t}");
    }
    // The normal distribution's, at so many degrees that there is no difference.
    for freedom in [1e7, 1e9, 1e12] {
        assert!((student_quantile(0.95, freedom) - 1.959_963_984_540_054).abs() < 1e-6, "{freedom}");
    }
}

#[test]
fn one_and_two_degrees_of_freedom_have_closed_forms() {
    for t in [1e-6, 0.01, 0.3, 1.0, 2.5, 12.706, 400.0] {
        let cauchy = 2.0 / PI * libm::atan(t);
        assert!((student_within(t, 1.0) - cauchy).abs() < 1e-13, "{t}");
        let of_two = t / sqrt(2.0 + t * t);
        assert!((student_within(t, 2.0) - of_two).abs() < 1e-13, "{t}");
        // Abramowitz and Stegun 26.7.3 for odd numbers.
        let angle = libm::atan(t / sqrt(3.0));
        let of_three = 2.0 / PI * (angle + libm::sin(angle) * libm::cos(angle));
        assert!((student_within(t, 3.0) - of_three).abs() < 1e-13, "{t}");
    }
}

#[test]
fn fractions_of_degrees_lie_between_and_none_has_no_quantile() {
    let mut before = f64::INFINITY;
    for step in 1..400 {
        let quantile = student_quantile(0.95, f64::from(step) / 4.0);
        assert!(quantile < before, "{step}");
        before = quantile;
    }
    assert!(student_quantile(0.95, 0.0).is_nan() && student_quantile(0.95, f64::NAN).is_nan());
}
