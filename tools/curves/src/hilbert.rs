//! Keys along Hilbert's space-filling curve in three dimensions.
//!
//! Skilling, *Programming the Hilbert curve*, AIP Conference Proceedings 707, 2004: coordinates to transposed index.

use super::spread;
use pm_formats::Bounds;

/// Bits of each coordinate: cells of 1/1024 of the scene, finer than what a cache line of photons covers.
pub const HILBERT_BITS: u32 = 10;

/// Bits of each coordinate where few points may share a cell; as many as three of them fit into 64.
pub const FINE_BITS: u32 = 21;

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

/// The key of a point within `bounds` on the curve of [`FINE_BITS`] bits a coordinate, for sorting by. The cells are cubes
/// as in [`hilbert_keys`], 2^21 along the longest side; points outside belong to the nearest cell.
#[must_use]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates at 0, and is below 2^21")]
pub fn fine_hilbert_key(bounds: &Bounds, point: [f32; 3]) -> u64 {
    // In double precision: a side of a cell is less than what single precision tells apart.
    let side = |axis: usize| f64::from(bounds.max[axis]) - f64::from(bounds.min[axis]);
    let longest = (0..3).map(side).fold(0.0, f64::max);
    let cells = f64::from(1u32 << FINE_BITS);
    let scale = if longest > 0.0 { cells / longest } else { 0.0 };
    let cell_of =
        |axis: usize| ((f64::from(point[axis]) - f64::from(bounds.min[axis])) * scale).min(cells - 1.0) as u32;
    hilbert_key([0, 1, 2].map(cell_of), FINE_BITS)
}

/// The key of one cell on the curve of `bits` (at most 21) bits a coordinate.
#[must_use]
pub fn hilbert_key(cell: [u32; 3], bits: u32) -> u64 {
    let transposed = transpose(cell.map(|coordinate| [coordinate]), bits);
    let next_bits =
        |key: u64, bit: u32| transposed.iter().fold(key, |key, [axis]| key << 1 | u64::from(axis >> bit & 1));
    (0..bits).rev().fold(0, next_bits)
}

/// Skilling's `AxestoTranspose` on several points at once, without branches.
#[expect(clippy::needless_range_loop, reason = "two coordinates of a lane are changed together")]
fn transpose<const LANES: usize>(mut x: [[u32; LANES]; 3], bits: u32) -> [[u32; LANES]; 3] {
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

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

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
    fn the_curve_of_orders_begins_along_z() {
        // What pm-reorder's help says of it: other curves of this name begin otherwise.
        let bounds = Bounds { min: [0.0; 3], max: [1024.0; 3] };
        let first = [[0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1], [1, 0, 0]];
        let points = first.map(|cell: [u8; 3]| cell.map(|x| f32::from(x) + 0.5));
        let keys = hilbert_keys(&bounds, &points, |&point| point);
        let mut cells: Vec<_> = keys.iter().zip(first).collect();
        cells.sort_unstable();
        assert_eq!(cells.iter().map(|(key, _)| **key).collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(cells.iter().map(|(_, cell)| *cell).collect::<Vec<_>>(), first);
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
            assert_eq!(u64::from(key), hilbert_key(cell, HILBERT_BITS), "{p:?}");
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
            assert!(points.iter().all(|&point| fine_hilbert_key(&bounds, point) < 1 << 63));
        }
    }

    #[test]
    fn the_fine_curve_goes_through_the_cells_of_coarser_ones_in_their_order() {
        // A curve of fewer bits is the same curve seen from afar.
        let mut random = Random::new(&[3]);
        for _ in 0..1000 {
            let cell = [(); 3].map(|()| (random.next_u64() >> 43) as u32);
            let key = hilbert_key(cell, FINE_BITS);
            for coarser in 1..FINE_BITS {
                let seen = hilbert_key(cell.map(|x| x >> coarser), FINE_BITS - coarser);
                assert_eq!(key >> (3 * coarser), seen, "{cell:?} {coarser}");
            }
        }
    }

    #[test]
    fn fine_keys_are_those_of_cells() {
        let bounds = Bounds { min: [-1.0, 0.0, 2.0], max: [1.0, 1.0, 3.0] };
        let side = 2.0 / f64::from(1 << FINE_BITS);
        let mut random = Random::new(&[4]);
        for _ in 0..1000 {
            let point = [0, 1, 2].map(|axis| bounds.min[axis] + random.unit() * (bounds.max[axis] - bounds.min[axis]));
            let cell = [0, 1, 2].map(|axis| (f64::from(point[axis] - bounds.min[axis]) / side) as u32);
            assert_eq!(fine_hilbert_key(&bounds, point), hilbert_key(cell, FINE_BITS));
        }
        let last = hilbert_key([(1 << FINE_BITS) - 1; 3], FINE_BITS);
        let cube = Bounds { min: [0.0; 3], max: [1.0; 3] };
        assert_eq!([fine_hilbert_key(&cube, [1.0; 3]), fine_hilbert_key(&cube, [9.0; 3])], [last; 2]);
    }
}
