//! Positions along Hilbert's curve, finely enough to sort photons by.
//!
//! Skilling, *Programming the Hilbert curve*, AIP Conference Proceedings 707, 2004.

/// Bits of each coordinate.
const BITS: u32 = 21;

/// The place of a position within bounds on the curve; the cells are cubes, 2^21 along the longest side.
pub(super) fn place_on_curve(position: [f32; 3], bounds: &([f32; 3], [f32; 3])) -> u64 {
    let side = |axis: usize| f64::from(bounds.1[axis]) - f64::from(bounds.0[axis]);
    let longest = (0..3).map(side).fold(0.0, f64::max);
    let cells = f64::from(1u32 << BITS);
    let scale = if longest > 0.0 { cells / longest } else { 0.0 };
    key(
        [0, 1, 2].map(|axis| ((f64::from(position[axis]) - f64::from(bounds.0[axis])) * scale).min(cells - 1.0) as u32),
        BITS,
    )
}

/// The number of a cell on the curve of `bits` bits a coordinate.
fn key(mut x: [u32; 3], bits: u32) -> u64 {
    for bit in (1..bits).rev() {
        let (set, low) = (1u32 << bit, (1u32 << bit) - 1);
        for axis in 0..3 {
            if x[axis] & set != 0 {
                x[0] ^= low;
            } else {
                let exchange = (x[0] ^ x[axis]) & low;
                x[0] ^= exchange;
                x[axis] ^= exchange;
            }
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let gray = (1..bits).filter(|bit| x[2] >> bit & 1 == 1).fold(0, |gray, bit| gray ^ ((1u32 << bit) - 1));
    let x = x.map(|coordinate| coordinate ^ gray);
    (0..bits).rev().fold(0, |key, bit| x.iter().fold(key, |key, axis| key << 1 | u64::from(axis >> bit & 1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_keys() {
        // Keys of Skilling's published program at 3 bits a coordinate.
        let known =
            [([0, 0, 0], 0), ([1, 0, 0], 1), ([0, 1, 0], 7), ([0, 0, 1], 3), ([7, 7, 7], 365), ([7, 0, 0], 511)];
        for (cell, place) in known {
            assert_eq!(key(cell, 3), place, "{cell:?}");
        }
    }

    #[test]
    fn odd_bounds_do_no_harm() {
        for bounds in [([0.0; 3], [0.0; 3]), ([0.0; 3], [1e-40; 3]), ([-1e18; 3], [1e18; 3])] {
            let places = [bounds.0, bounds.1].map(|corner| place_on_curve(corner, &bounds));
            assert!(places.into_iter().all(|place| place < 1 << 63));
        }
    }
}
