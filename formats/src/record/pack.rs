//! Packed forms: unit vectors on an octahedron, colours with a shared exponent.

/// Projects a unit vector onto the octahedron `|x| + |y| + |z| = 1`, lower half folded out: two numbers in [-1, 1].
///
/// Cigolle, Donow, Evangelakos, Mara, McGuire, Meyer: *A Survey of Efficient Representations for Independent Unit
/// Vectors*, JCGT 3(2), 2014, section 3.2.
fn to_octahedron(v: [f32; 3]) -> [f32; 2] {
    let sum = v[0].abs() + v[1].abs() + v[2].abs();
    let (x, y) = (v[0] / sum, v[1] / sum);
    if v[2] >= 0.0 { [x, y] } else { [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)] }
}

fn from_octahedron([x, y]: [f32; 2]) -> [f32; 3] {
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    let (x, y) = (x - fold.copysign(x), y - fold.copysign(y));
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

/// A number in [-1, 1] in `2 * half + 1` steps, of which the middle one is exactly 0: vectors along an axis are exact.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0 ..= 2 * half")]
fn quantise(x: f32, half: f32) -> u16 {
    (x * half + half).round().clamp(0.0, 2.0 * half) as u16
}

/// Packs a unit vector with `BITS` bits a coordinate, low coordinate in the low bits. The zero vector and what is not
/// finite become the z axis.
#[must_use]
pub fn pack_direction<const BITS: u32>(v: [f32; 3]) -> u32 {
    let half = f32::from((1u16 << (BITS - 1)) - 1);
    let [x, y] = to_octahedron(v);
    let [x, y] = if x.is_finite() && y.is_finite() { [x, y] } else { [0.0, 0.0] };
    u32::from(quantise(x, half)) | u32::from(quantise(y, half)) << BITS
}

/// The unit vector that was packed, to within the quantisation (0.0001 rad at 16 bits, 0.034 at 7).
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "masked to at most 16 bits")]
pub fn unpack_direction<const BITS: u32>(packed: u32) -> [f32; 3] {
    let half = f32::from((1u16 << (BITS - 1)) - 1);
    let coordinate = |bits: u32| f32::from((bits & ((1 << BITS) - 1)) as u16) / half - 1.0;
    from_octahedron([coordinate(packed), coordinate(packed >> BITS)])
}

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
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_colours() {
        // Ward's own example: white of radiance 1 is mantissa 128 at exponent 129.
        assert_eq!(pack_rgbe([1.0, 1.0, 1.0], [0.5; 3]), Some([128, 128, 128, 129]));
        assert_eq!(pack_rgbe([0.0; 3], [0.0; 3]), Some([0; 4]));
        assert_eq!(unpack_rgbe([128, 64, 0, 129]), [1.0, 0.5, 0.0]);
        assert_eq!(pack_rgbe([f32::NAN, 0.0, 0.0], [0.5; 3]), None);
        assert_eq!(pack_rgbe([-1.0, 0.0, 0.0], [0.5; 3]), None);
        assert_eq!(pack_rgbe([f32::MAX, 0.0, 0.0], [0.5; 3]), None);
    }

    #[test]
    fn the_largest_mantissa_never_overflows() {
        // 255.9 would round up to 256: it must move to the next exponent instead.
        let packed = pack_rgbe([255.9, 1.0, 0.0], [0.0; 3]).unwrap();
        let back = unpack_rgbe(packed);
        assert!((back[0] - 255.9).abs() <= 2.0, "{back:?}");
    }

    #[test]
    fn rounding_is_unbiased() {
        // The mean over uniform thresholds is the number itself: a plain round or floor fails.
        for value in [0.7317_f32, 255.3e-6, 254.9, 1.003e12, 3.1e-12] {
            let n = 4096;
            let mean: f64 = (0..n)
                .map(|i| unpack_rgbe(pack_rgbe([value, value / 3.0, 0.0], [(i as f32 + 0.5) / n as f32; 3]).unwrap()))
                .map(|rgb| rgb[0] + rgb[1])
                .sum::<f64>()
                / f64::from(n);
            let exact = f64::from(value) + f64::from(value / 3.0);
            assert!((mean / exact - 1.0).abs() < 2e-5, "{value}: {mean} for {exact}");
        }
    }

    #[test]
    fn a_million_random_powers_keep_their_mean() {
        // Numbers and thresholds of SplitMix64 (Steele, Lea, Flood: *Fast Splittable Pseudorandom Number Generators*,
        // OOPSLA 2014). Within 0.05 % in each channel; rounding down would lose 0.3 % of the brightest and more of others.
        let mut state = 0u64;
        let mut random = || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
        };
        let (mut exact, mut packed) = ([0f64; 3], [0f64; 3]);
        for _ in 0..1_000_000 {
            let scale = 10f32.powf(random() * 4.0 - 2.0);
            let rgb = [random(), random(), random()].map(|x| x * scale);
            let back = unpack_rgbe(pack_rgbe(rgb, [random(), random(), random()]).unwrap());
            (0..3).for_each(|c| {
                exact[c] += f64::from(rgb[c]);
                packed[c] += back[c];
            });
        }
        for channel in 0..3 {
            let ratio = packed[channel] / exact[channel];
            assert!((ratio - 1.0).abs() < 5e-4, "channel {channel}: mean of the packed / mean = {ratio}");
        }
    }

    #[test]
    fn axes_are_exact() {
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                let mut v = [0.0; 3];
                v[axis] = sign;
                assert_eq!(unpack_direction::<16>(pack_direction::<16>(v)), v);
                assert_eq!(unpack_direction::<7>(pack_direction::<7>(v)), v);
            }
        }
    }

    proptest! {
        #[test]
        fn directions_come_back(x in -1f32..1.0, y in -1f32..1.0, z in -1f32..1.0) {
            let length = (x * x + y * y + z * z).sqrt();
            prop_assume!(length > 1e-3);
            let v = [x / length, y / length, z / length];
            let error = |w: [f32; 3]| (0..3).map(|i| (v[i] - w[i]).powi(2)).sum::<f32>().sqrt();
            // Half a step h in x and y moves z by 2 h: sqrt(6) h in the plane of a face, whose centre is 1 / sqrt(3) from
            // the origin. So an angle of sqrt(18) h; 1 % for what is not linear, and what f32 rounds.
            let bound = |half: f32| 18f32.sqrt() * 0.5 / half * 1.01 + 1e-6;
            prop_assert!(error(unpack_direction::<16>(pack_direction::<16>(v))) < bound(32767.0));
            prop_assert!(error(unpack_direction::<8>(pack_direction::<8>(v))) < bound(127.0));
            prop_assert!(error(unpack_direction::<7>(pack_direction::<7>(v))) < bound(63.0));
        }

        #[test]
        fn colours_come_back(r in 0f32..1e3, g in 0f32..1e3, b in 0f32..1e3, t in 0f32..1.0) {
            let back = unpack_rgbe(pack_rgbe([r, g, b], [t; 3]).unwrap());
            let largest = f64::from(r.max(g).max(b));
            for (x, y) in [r, g, b].into_iter().zip(back) {
                prop_assert!((f64::from(x) - y).abs() <= largest / 127.0);
            }
        }
    }
}
