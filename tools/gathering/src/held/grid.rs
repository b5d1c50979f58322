//! The cube around the samples, halved again and again.

use super::Sample;

/// Halvings of the cube that coordinates tell apart.
pub(super) const FINEST: u32 = 15;
/// Room beyond the outermost samples, as a share of the longest side.
const MARGIN: f64 = 1.0 / 128.0;

/// A cube, and how wide it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cube {
    low: [f64; 3],
    side: f64,
}

impl Cube {
    /// A cube around these samples, with a [`MARGIN`] for points of their surfaces that lie a little beyond them.
    pub(super) fn around(samples: &[Sample]) -> Self {
        let along = |axis: usize| samples.iter().map(move |sample| f64::from(sample.position[axis]));
        let least = [0, 1, 2].map(|axis| along(axis).fold(f64::INFINITY, f64::min));
        let side = (0..3).map(|axis| along(axis).fold(f64::NEG_INFINITY, f64::max) - least[axis]).fold(0.0, f64::max);
        // All at one point, or none at all: any width will do.
        let side = if side > 0.0 { side } else { 1.0 };
        let low = least.map(|x| if x.is_finite() { x - side * MARGIN } else { 0.0 });
        Self { low, side: side * (1.0 + 2.0 * MARGIN) }
    }

    /// Coordinates of a point in the finest cells; of one outside those of the nearest cell along each axis.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    pub(super) fn finest(&self, point: [f32; 3]) -> [u32; 3] {
        let last = f64::from((1u32 << FINEST) - 1);
        let cell = |axis: usize| (f64::from(point[axis]) - self.low[axis]) / self.side * f64::from(1u32 << FINEST);
        [0, 1, 2].map(|axis| cell(axis).floor().clamp(0.0, last) as u32)
    }

    /// Width of a cell after so many halvings.
    pub(super) fn width(&self, halvings: u32) -> f64 {
        self.side / f64::from(1u32 << halvings)
    }

    /// Centre of a cell after so many halvings.
    pub(super) fn centre(&self, cell: [u32; 3], halvings: u32) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.low[axis] + (f64::from(cell[axis]) + 0.5) * self.width(halvings))
    }
}

/// The cell after so many halvings that holds a finest cell.
pub(super) fn above(finest: [u32; 3], halvings: u32) -> [u32; 3] {
    finest.map(|x| x >> (FINEST - halvings))
}
