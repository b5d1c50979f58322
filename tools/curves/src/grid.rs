//! Cells of a regular grid over the scene: cubes counted from the least corner of its bounds.

use pm_formats::Bounds;

/// A grid of cubes. Points outside of the bounds belong to the nearest cell.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    min: [f32; 3],
    /// Cells to a unit of length; 0 where the bounds have no extent to speak of, and all points share a cell.
    scale: f32,
    /// Cells along each side.
    cells: [u32; 3],
}

impl Grid {
    /// Cubes of which `across` fit along the longest side of the bounds.
    #[must_use]
    pub fn across(bounds: &Bounds, across: u32) -> Self {
        Self::with_scale(bounds, across as f32 / extent(bounds), across)
    }

    /// Cubes of this side in scene units; at most `most` of them along a side.
    #[must_use]
    pub fn of_side(bounds: &Bounds, side: f32, most: u32) -> Self {
        Self::with_scale(bounds, 1.0 / side, most)
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is clamped")]
    fn with_scale(bounds: &Bounds, scale: f32, most: u32) -> Self {
        let scale = Some(scale).filter(|scale| scale.is_finite()).unwrap_or(0.0);
        let along = |axis: usize| ((bounds.max[axis] - bounds.min[axis]) * scale).ceil() as u32;
        Self { min: bounds.min, scale, cells: [0, 1, 2].map(|axis| along(axis).clamp(1, most)) }
    }

    /// Cells along each axis.
    #[must_use]
    pub const fn cells(&self) -> [u32; 3] {
        self.cells
    }

    /// The cell of a point.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is clamped")]
    pub fn cell(&self, point: [f32; 3]) -> [u32; 3] {
        [0, 1, 2].map(|axis| (((point[axis] - self.min[axis]) * self.scale) as u32).min(self.cells[axis] - 1))
    }
}

/// Length of the longest side of the bounds, in scene units.
#[must_use]
fn extent(bounds: &Bounds) -> f32 {
    (0..3).map(|axis| bounds.max[axis] - bounds.min[axis]).fold(0.0, f32::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_cubes_and_cover_the_bounds() {
        let bounds = Bounds { min: [-1.0, 0.0, 2.0], max: [1.0, 1.0, 2.25] };
        let grid = Grid::across(&bounds, 8);
        assert_eq!(grid.cells(), [8, 4, 1]);
        assert_eq!(grid.cell([-1.0, 0.0, 2.0]), [0, 0, 0]);
        assert_eq!(grid.cell([0.3, 0.3, 2.1]), [5, 1, 0]);
        assert_eq!(grid.cell([1.0, 1.0, 2.25]), [7, 3, 0]);
        assert_eq!(grid.cell([9.0, -9.0, 9.0]), [7, 0, 0]);
        assert_eq!(Grid::of_side(&bounds, 0.25, 32).cells(), [8, 4, 1]);
        assert_eq!(Grid::of_side(&bounds, 1e-9, 32).cells(), [32, 32, 32]);
    }

    #[test]
    fn odd_bounds_do_no_harm() {
        for bounds in [
            Bounds { min: [0.0; 3], max: [0.0; 3] },
            Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] },
            Bounds { min: [f32::MIN; 3], max: [f32::MAX; 3] },
            Bounds { min: [0.0; 3], max: [1e-42; 3] },
        ] {
            for grid in [Grid::across(&bounds, 32), Grid::of_side(&bounds, extent(&bounds) / 32.0, 64)] {
                for point in [[0.0; 3], [1e30; 3], [f32::MIN; 3], [f32::MAX; 3]] {
                    let cell = grid.cell(point);
                    assert!((0..3).all(|axis| cell[axis] < grid.cells()[axis]), "{bounds:?} {point:?} {cell:?}");
                }
            }
        }
    }
}
