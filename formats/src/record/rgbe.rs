//! Colours with a shared exponent.

/// Least power of two an RGBE mantissa can stand for: values below it vanish.
const RGBE_BIAS: i32 = 136;

/// Three non-negative numbers as 8-bit mantissas with a shared exponent (Ward, *Real Pixels*, Graphics Gems II, 1991):
/// value = mantissa * 2^(exponent - 136), exponent 0 for black.
///
/// Mantissas are rounded up where the fraction lost exceeds `threshold` (in [0, 1), one for each channel): with uniform
/// thresholds the expectation is exact. `None` if a number is negative, not finite, or beyond 2^127.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "mantissas are at most 255 by construction"
)]
pub fn pack_rgbe(rgb: [f32; 3], threshold: [f32; 3]) -> Option<[u8; 4]> {
    if !rgb.iter().all(|c| c.is_finite() && *c >= 0.0) {
        return None;
    }
    let largest = f64::from(rgb[0].max(rgb[1]).max(rgb[2]));
    if largest == 0.0 {
        return Some([0; 4]);
    }
    // largest = f * 2^power with 0.5 <= f < 1, read from the bits (every f32 is a normal f64).
    let power = ((largest.to_bits() >> 52) & 0x7ff) as i32 - 1022;
    let mut exponent = power + RGBE_BIAS - 8;
    // The largest mantissa must not round up to 256: then rounding needs no second look and stays unbiased.
    if largest > 255.0 * exp2(exponent - RGBE_BIAS) {
        exponent += 1;
    }
    if exponent > 255 {
        return None;
    }
    if exponent < 1 {
        return Some([0; 4]);
    }
    let scale = exp2(RGBE_BIAS - exponent);
    let mantissa = |channel: usize| {
        let exact = f64::from(rgb[channel]) * scale;
        let floor = exact.floor();
        floor as u8 + u8::from(exact - floor > f64::from(threshold[channel]))
    };
    Some([mantissa(0), mantissa(1), mantissa(2), exponent as u8])
}

/// The numbers that were packed.
#[inline]
#[must_use]
pub fn unpack_rgbe([r, g, b, exponent]: [u8; 4]) -> [f64; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let unit = exp2(i32::from(exponent) - RGBE_BIAS);
    [f64::from(r) * unit, f64::from(g) * unit, f64::from(b) * unit]
}

/// 2^power, exactly, for powers of normal doubles.
#[expect(clippy::cast_sign_loss, reason = "the biased exponent is positive")]
fn exp2(power: i32) -> f64 {
    debug_assert!((-1022..=1023).contains(&power));
    f64::from_bits(((power + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests;
