//! Sine and cosine of a share of a turn, without a branch.

use std::f64::consts::FRAC_PI_2;

/// Odd multiples of an eighth of a turn, as bits, rounded as FreeBSD's `s_sinf.c` has them:
/// the last numbers of four quarters.
const QUARTERS: [u32; 4] = [0x3f49_0fda, 0x4016_cbe3, 0x407b_53d1, 0x40af_eddf];

/// Sine and cosine of the share `v` of a turn, 0 to 1: to the bit what `libm::sincosf` makes of `2 pi v`, in half the time.
/// That asks which of five quarters it is in, which is as random as `v`.
///
/// The polynomials are those of FreeBSD's `k_sinf.c` and `k_cosf.c`, which `libm` has as well.
#[inline]
pub(super) fn sin_cos_of_turn(v: f32) -> (f32, f32) {
    let angle = 2.0 * std::f32::consts::PI * v;
    let after = |last: u32| u32::from(angle.to_bits() > last);
    let quarter = after(QUARTERS[0]) + after(QUARTERS[1]) + after(QUARTERS[2]) + after(QUARTERS[3]);
    let x = f64::from(angle) - f64::from(quarter.cast_signed()) * FRAC_PI_2;
    let (sin, cos) = (sin(x), cos(x));
    let (along_y, along_x) = if quarter & 1 == 0 { (sin, cos) } else { (cos, sin) };
    let negated = |number: f32, bit: u32| f32::from_bits(number.to_bits() ^ (bit & 2) << 30);
    (negated(along_y, quarter), negated(along_x, quarter + 1))
}

/// Within an eighth of a turn.
#[inline]
fn sin(x: f64) -> f32 {
    let z = x * x;
    let last = -0.000_198_393_348_360_966_32 + z * 0.000_002_718_311_493_989_822;
    let cube = z * x;
    ((x + cube * (-0.166_666_666_416_265_24 + z * 0.008_333_329_385_889_463)) + cube * (z * z) * last) as f32
}

/// Within an eighth of a turn.
#[inline]
fn cos(x: f64) -> f32 {
    let z = x * x;
    let w = z * z;
    let last = -0.001_388_676_377_460_993 + z * 0.000_024_390_448_796_277_41;
    (((1.0 + z * -0.499_999_997_251_031) + w * 0.041_666_623_323_739_06) + (w * z) * last) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    #[test]
    fn the_bits_are_those_of_the_library() {
        let same = |v: f32| {
            let (sin, cos) = sin_cos_of_turn(v);
            let (expected_sin, expected_cos) = libm::sincosf(2.0 * std::f32::consts::PI * v);
            assert_eq!([sin, cos].map(f32::to_bits), [expected_sin, expected_cos].map(f32::to_bits), "{v}");
        };
        // All about where one quarter ends, 0 and 1; multiples of 2^-24 as from random numbers; and some of any size.
        for middle in [0.125f32, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0] {
            (0..2000u32)
                .map(|step| f32::from_bits(middle.to_bits() - 1000 + step))
                .filter(|&v| v <= 1.0)
                .for_each(same);
        }
        (0..1 << 24).step_by(7).map(|step| step as f32 / 16_777_216.0).for_each(same);
        let mut random = Random::new(&[3]);
        (0..1_000_000).map(|_| f32::from_bits((random.next_u64() >> 32) as u32 % 1f32.to_bits())).for_each(same);
    }
}
