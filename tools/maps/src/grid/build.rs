//! Sorting photons into the cells of a grid.

use super::{Cells, Grid, HEADER};
use crate::BuildError;
use crate::error::check;
use crate::geometry::extent;
use crate::point::Point;
use pm_formats::Photon;

/// Photons for each cell of the grid, on average over all cells, most of which are empty.
const PHOTONS_PER_CELL: usize = 4;

/// What fixed cells have room for unless asked, at most, in multiples of the photons there are.
const MOST_SLOTS: usize = 16;

impl Grid {
    /// Builds the grid in O(n log n).
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(photons: &[Photon], cells: Cells) -> Result<Self, BuildError> {
        check(photons)?;
        let (low, high) = if photons.is_empty() {
            ([0.0; 3], [0.0; 3])
        } else {
            extent(photons.iter().map(|photon| photon.position))
        };
        let extents = [0, 1, 2].map(|axis| f64::from(high[axis]) - f64::from(low[axis]));
        let (side, counts) = cubes(extents, (photons.len() / PHOTONS_PER_CELL).max(1));
        let mut grid = Self {
            origin: low.map(f64::from),
            side,
            counts,
            starts: vec![],
            points: vec![],
            fixed: None,
            lost: 0,
            photons: photons.len(),
        };
        let mut by_cell: Vec<(u32, Point)> =
            Point::all(photons).into_iter().map(|point| (grid.cell(point.position), point)).collect();
        by_cell.sort_unstable_by_key(|&(cell, point)| (cell, point.id));
        let mut slots = usize::MAX;
        if let Cells::Fixed { line, slots: wanted } = cells {
            let occupied = by_cell.chunk_by(|a, b| a.0 == b.0).count().max(1);
            let bytes = fixed_bytes(photons.len(), occupied, counts.iter().product(), line, wanted)?;
            slots = (bytes - HEADER) as usize / size_of::<Photon>();
            grid.fixed = Some((bytes, line));
        }
        grid.starts = vec![0; counts.iter().product::<usize>() + 1];
        let mut next = 0;
        for cell in by_cell.chunk_by(|a, b| a.0 == b.0) {
            let at = cell[0].0 as usize;
            grid.starts[next..=at].fill(grid.points.len() as u32);
            next = at + 1;
            grid.points.extend(cell.iter().take(slots).map(|&(_, point)| point));
            grid.lost += cell.len().saturating_sub(slots);
        }
        grid.starts[next..].fill(grid.points.len() as u32);
        Ok(grid)
    }
}

/// Bytes of a fixed cell, in whole lines, of so many `cells` of which some are `occupied` by `photons` photons.
fn fixed_bytes(
    photons: usize,
    occupied: usize,
    cells: usize,
    line: u32,
    slots: Option<u32>,
) -> Result<u32, BuildError> {
    let most = MOST_SLOTS * photons / cells;
    let slots = slots.map_or((2 * photons).div_ceil(occupied).min(most).max(1), |slots| slots as usize);
    let line = u64::from(line.max(1));
    let bytes = (u64::from(HEADER) + slots as u64 * size_of::<Photon>() as u64).next_multiple_of(line);
    let lines = cells as u64 * (bytes / line);
    u32::try_from(bytes).ok().filter(|_| lines <= u64::from(u32::MAX)).ok_or(BuildError::TooLarge)
}

/// The smallest cubes of which `most` cover a box, and how many of them along each side.
pub(super) fn cubes(extents: [f64; 3], most: usize) -> (f64, [usize; 3]) {
    let counts = |side: f64| extents.map(|extent| (extent / side) as usize + 1);
    let longest = extents.into_iter().fold(0.0, f64::max);
    if longest <= 0.0 {
        return (1.0, [1; 3]);
    }
    // Within these there is a number of cubes that will do: one along the longest side, and all of them.
    let (mut small, mut large) = (longest / most as f64 / 2.0, longest * 2.0);
    for _ in 0..64 {
        let middle = (small * large).sqrt();
        let [x, y, z] = counts(middle);
        if x.saturating_mul(y).saturating_mul(z) <= most { large = middle } else { small = middle }
    }
    (large, counts(large))
}
