//! Cells of a scene, and the curves that go through them: Hilbert's and Morton's.

mod grid;
mod hilbert;
mod morton;

pub use grid::Grid;
pub use hilbert::{FINE_BITS, HILBERT_BITS, fine_hilbert_key, hilbert_key, hilbert_keys};
pub use morton::{morton_key, morton_keys};

/// Ten bits, three places apart.
const fn spread(bits: u32) -> u32 {
    let mut x = bits & 0x3ff;
    x = (x | x << 16) & 0x0300_00ff;
    x = (x | x << 8) & 0x0300_f00f;
    x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}
