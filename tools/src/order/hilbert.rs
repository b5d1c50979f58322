//! Keys along Hilbert's space-filling curve in three dimensions.
//!
//! Skilling, *Programming the Hilbert curve*, AIP Conference Proceedings 707, 2004: coordinates to transposed index.

use pm_formats::Bounds;

/// Bits of each coordinate: cells of 1/1024 of the scene, finer than what a cache line of photons covers.
pub const HILBERT_BITS: u32 = 10;

/// Points that are keyed together: plain loops over this many are what compilers turn into vector code.
const LANES: usize = 16;

/// The keys of points within `bounds`, `3 * HILBERT_BITS` bits each. The cells are cubes: the bounds' longest side has
/// 1024 of them. Points outside belong to the nearest cell.
#[must_use]
pub fn hilbert_keys<T>(bounds: &Bounds, points: &[T], position: impl Fn(&T) -> [f32; 3]) -> Vec<u32> {
    let mut keys = Vec::with_capacity(points.len());
    let extent = (0..3).map(|axis| bounds.max[axis] - bounds.min[axis]).fold(0.0, f32::max);
    let cells = (1u32 << HILBERT_BITS) as f32;
    // Flat or tiny bounds may have no extent to speak of: then all points share a cell.
    let scale = Some(cells / extent).filter(|scale| scale.is_finite()).unwrap_or(0.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let cell_of = |x: f32, axis: usize| ((x - bounds.min[axis]) * scale).clamp(0.0, cells - 1.0) as u32;
    for chunk in points.chunks(LANES) {
        let mut cell = [[0u32; LANES]; 3];
        for (lane, point) in chunk.iter().enumerate() {
            let p = position(point);
            for axis in 0..3 {
                cell[axis][lane] = cell_of(p[axis], axis);
            }
        }
        let transposed = transpose(cell, HILBERT_BITS);
        keys.extend((0..chunk.len()).map(|lane| {
            let part = |axis: usize, shift: u32| spread(transposed[axis][lane]) << shift;
            part(0, 2) | part(1, 1) | part(2, 0)
        }));
    }
    keys
}

/// The key of one cell on the curve of `bits` (at most 10) bits a coordinate.
#[must_use]
pub fn hilbert_key(cell: [u32; 3], bits: u32) -> u32 {
    let mut lanes = [[0; LANES]; 3];
    for axis in 0..3 {
        lanes[axis][0] = cell[axis];
    }
    let transposed = transpose(lanes, bits);
    spread(transposed[0][0]) << 2 | spread(transposed[1][0]) << 1 | spread(transposed[2][0])
}

/// Skilling's `AxestoTranspose` on `LANES` points at once, without branches.
#[expect(clippy::needless_range_loop, reason = "two coordinates of a lane are changed together")]
fn transpose(mut x: [[u32; LANES]; 3], bits: u32) -> [[u32; LANES]; 3] {
    // All ones if the bit is set.
    let mask = |value: u32, bit: u32| ((value >> bit) & 1).wrapping_neg();
    for bit in (1..bits).rev() {
        let low = (1u32 << bit) - 1;
        for axis in 0..3 {
            for lane in 0..LANES {
                let (first, this) = (x[0][lane], x[axis][lane]);
                let set = mask(this, bit);
                // Bit set: invert the first coordinate's low bits. Else: exchange them with this one's.
                let exchange = (first ^ this) & low & !set;
                x[0][lane] = first ^ exchange ^ (low & set);
                if axis > 0 {
                    x[axis][lane] = this ^ exchange;
                }
            }
        }
    }
    for lane in 0..LANES {
        x[1][lane] ^= x[0][lane];
        x[2][lane] ^= x[1][lane];
        let mut gray = 0;
        for bit in 1..bits {
            gray ^= ((1u32 << bit) - 1) & mask(x[2][lane], bit);
        }
        for axis in &mut x {
            axis[lane] ^= gray;
        }
    }
    x
}

/// Ten bits, three places apart.
pub(super) const fn spread(bits: u32) -> u32 {
    let mut x = bits & 0x3ff;
    x = (x | x << 16) & 0x0300_00ff;
    x = (x | x << 8) & 0x0300_f00f;
    x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_keys() {
        // Keys of Skilling's published program at 3 bits a coordinate.
        let keys = [
            ([0, 0, 0], 0),
            ([1, 0, 0], 1),
            ([0, 1, 0], 7),
            ([0, 0, 1], 3),
            ([7, 7, 7], 365),
            ([7, 0, 0], 511),
            ([3, 5, 1], 253),
        ];
        for (cell, key) in keys {
            assert_eq!(hilbert_key(cell, 3), key, "{cell:?}");
        }
    }

    #[test]
    fn one_to_one_and_neighbours_on_the_curve_are_neighbours_in_space() {
        for bits in 1..=5u32 {
            let side = 1u32 << bits;
            let mut cells = vec![None; (side * side * side) as usize];
            for x in 0..side {
                for y in 0..side {
                    for z in 0..side {
                        let place = &mut cells[hilbert_key([x, y, z], bits) as usize];
                        assert_eq!(*place, None);
                        *place = Some([x, y, z]);
                    }
                }
            }
            for pair in cells.windows(2) {
                let steps = (0..3).map(|i| pair[0].unwrap()[i].abs_diff(pair[1].unwrap()[i])).sum::<u32>();
                assert_eq!(steps, 1, "{pair:?}");
            }
        }
    }

    #[test]
    fn lanes_agree_with_single_keys_and_odd_points_do_no_harm() {
        let bounds = Bounds { min: [-1.0, 0.0, 2.0], max: [1.0, 1.0, 3.0] };
        let points: Vec<[f32; 3]> = (0..37u8).map(|i| [f32::from(i) * 0.05 - 1.0, f32::from(i) * 0.02, 2.5]).collect();
        let keys = hilbert_keys(&bounds, &points, |&p| p);
        for (p, key) in points.iter().zip(keys) {
            let cell = [0, 1, 2].map(|axis| ((p[axis] - bounds.min[axis]) * 512.0) as u32);
            assert_eq!(key, hilbert_key(cell, HILBERT_BITS), "{p:?}");
        }
        // Flat, inverted, infinitely large and tiny bounds; points outside.
        for bounds in [
            Bounds { min: [0.0; 3], max: [0.0; 3] },
            Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] },
            Bounds { min: [f32::MIN; 3], max: [f32::MAX; 3] },
            Bounds { min: [0.0; 3], max: [1e-42; 3] },
        ] {
            let points = [[0.0; 3], [1e30; 3], [-1e30; 3], [f32::MAX; 3]];
            assert!(hilbert_keys(&bounds, &points, |&p| p).iter().all(|&key| key < 1 << 30));
        }
    }
}
