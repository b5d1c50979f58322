//! Distances and boxes, computed alike by all maps.

/// Squared distance as every map computes it.
#[inline(always)]
#[must_use]
pub fn distance_squared(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [dx, dy, dz] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (dx * dx + dy * dy) + dz * dz
}

/// Least and greatest coordinates along each axis.
pub(super) type Box3 = ([f32; 3], [f32; 3]);

/// The smallest box that holds all of some positions.
#[inline]
pub(super) fn extent(positions: impl IntoIterator<Item = [f32; 3]>) -> Box3 {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for position in positions {
        for axis in 0..3 {
            // One instruction each, where `min` and `max` take several: it is false for what is no number.
            low[axis] = if position[axis] < low[axis] { position[axis] } else { low[axis] };
            high[axis] = if position[axis] > high[axis] { position[axis] } else { high[axis] };
        }
    }
    (low, high)
}

/// The axis along which a box is longest, the first of equals.
pub(super) fn longest_axis(bounds: &Box3) -> usize {
    let side = |axis: usize| bounds.1[axis] - bounds.0[axis];
    (1..3).fold(0, |longest, axis| if side(axis) > side(longest) { axis } else { longest })
}
