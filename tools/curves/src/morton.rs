//! Keys along Morton's curve: the bits of the three coordinates in turn.
//!
//! Morton, *A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing*, IBM, 1966.

use super::{Grid, HILBERT_BITS, spread};
use pm_formats::Bounds;

/// The keys of points within `bounds`, of the same 1024 cells a side as Hilbert's.
#[must_use]
pub fn morton_keys<T>(bounds: &Bounds, points: &[T], position: impl Fn(&T) -> [f32; 3]) -> Vec<u32> {
    let grid = Grid::across(bounds, 1 << HILBERT_BITS);
    points.iter().map(|point| morton_key(grid.cell(position(point)))).collect()
}

/// The key of a cell: bit i of x is bit 3i + 2 of the key, that of y bit 3i + 1, that of z bit 3i.
#[must_use]
pub const fn morton_key([x, y, z]: [u32; 3]) -> u32 {
    spread(x) << 2 | spread(y) << 1 | spread(z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_interleaved() {
        assert_eq!(morton_key([0, 0, 0]), 0);
        assert_eq!(morton_key([1, 0, 0]), 0b100);
        assert_eq!(morton_key([0, 1, 0]), 0b010);
        assert_eq!(morton_key([0, 0, 1]), 0b001);
        assert_eq!(morton_key([5, 1, 0]), 0b100_000_110);
        assert_eq!(morton_key([1023; 3]), (1 << 30) - 1);
    }

    #[test]
    fn one_to_one() {
        let mut keys: Vec<u32> = (0..4096).map(|i| morton_key([i & 15, i >> 4 & 15, i >> 8])).collect();
        keys.sort_unstable();
        assert!(keys.iter().copied().eq(0..4096));
    }
}
