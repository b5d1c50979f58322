//! Unit vectors on an octahedron.

/// Projects a unit vector onto the octahedron `|x| + |y| + |z| = 1`, lower half folded out: two numbers in [-1, 1].
///
/// Cigolle, Donow, Evangelakos, Mara, McGuire, Meyer: *A Survey of Efficient Representations for Independent Unit
/// Vectors*, JCGT 3(2), 2014, section 3.2.
#[inline]
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
#[inline]
fn quantise(x: f32, half: f32) -> u16 {
    let steps = (x * half + half).clamp(0.0, 2.0 * half);
    // Halves go up, as `round` has them, which is a call to the C library on most machines.
    let below = steps as u16;
    below + u16::from(steps - f32::from(below) >= 0.5)
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

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
    }
}
