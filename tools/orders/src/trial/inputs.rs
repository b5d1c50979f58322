//! Queries that orders are tried on.

use bytemuck::Zeroable as _;
use pm_formats::{Bounds, Query};
use pm_random::Random;

/// The unit cube.
pub(super) const UNIT: Bounds = Bounds { min: [0.0; 3], max: [1.0; 3] };

/// So many queries, four of each pixel, at these positions.
#[must_use]
pub fn queries(n: u32, position: impl Fn(&mut Random) -> [f32; 3]) -> Vec<Query> {
    let mut random = Random::new(&[u64::from(n)]);
    (0..n).map(|i| Query { position: position(&mut random), pixel: i / 4, sample: i % 4, ..Query::zeroed() }).collect()
}

/// Anywhere in the unit cube.
pub(super) fn in_a_cube(random: &mut Random) -> [f32; 3] {
    [(); 3].map(|()| random.unit())
}

/// What is hard for cells and curves: a name, the bounds of the scene, and queries.
pub(super) fn hard(n: u32) -> Vec<(&'static str, Bounds, Vec<Query>)> {
    let flat = Bounds { min: [0.0, 0.5, 0.0], max: [1.0, 0.5, 1.0] };
    let tiny = Bounds { min: [0.0; 3], max: [1e-42; 3] };
    let vast = Bounds { min: [f32::MIN; 3], max: [f32::MAX; 3] };
    vec![
        ("anywhere", UNIT, queries(n, in_a_cube)),
        ("at one point", UNIT, queries(n, |_| [0.5; 3])),
        ("out of bounds", UNIT, queries(n, |_| [f32::MAX, f32::MIN, 0.0])),
        ("in a flat scene", flat, queries(n, |random| [random.unit(), 0.5, random.unit()])),
        ("in a tiny scene", tiny, queries(n, |random| [random.unit() * 1e-42, 0.0, 1e-42])),
        ("in a vast scene", vast, queries(n, |random| [(random.unit() - 0.5) * f32::MAX, f32::MIN_POSITIVE, -0.0])),
    ]
}
