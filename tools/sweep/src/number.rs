//! Numbers as text, as C's `%g` has them.

/// A number with so many significant digits and no trailing zeros; with an exponent where it is below 1e-4 or has more digits
/// before the point.
#[must_use]
pub fn significant(x: f64, digits: u8) -> String {
    let digits = i32::from(digits.max(1));
    if !x.is_finite() || x == 0.0 {
        return if x == 0.0 { "0".into() } else { x.to_string().to_lowercase() };
    }
    // Scientific form rounds first, so that the exponent of 9.9999999 is that of 10.
    let scientific = format!("{x:.*e}", (digits - 1) as usize);
    let (mantissa, exponent) = scientific.split_once('e').expect("an exponent");
    let exponent: i32 = exponent.parse().expect("a number");
    let short = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    if (-4..digits).contains(&exponent) {
        return short(&format!("{x:.*}", (digits - 1 - exponent) as usize));
    }
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{}e{sign}{:02}", short(mantissa), exponent.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_as_c_has_them() {
        // What printf of the C library prints for %.15g, %.5g and %.2g.
        for (x, digits, expected) in [
            (65.550_386_015_927_47, 15, "65.5503860159275"),
            (20.0, 15, "20"),
            (9.639_739_368_676_535e-5, 15, "9.63973936867653e-05"),
            (0.000_1, 15, "0.0001"),
            (1e15, 15, "1e+15"),
            (123_456_789_012_345.0, 15, "123456789012345"),
            (99_999.6, 5, "1e+05"),
            (-0.012_345_6, 5, "-0.012346"),
            (0.099_6, 2, "0.1"),
            (0.0, 15, "0"),
        ] {
            assert_eq!(significant(x, digits), expected);
        }
        assert_eq!((significant(f64::NAN, 5), significant(f64::NEG_INFINITY, 5)), ("nan".into(), "-inf".into()));
    }
}
