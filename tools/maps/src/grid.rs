//! The uniform grid, in the two forms that GI'05 looked at: cells of fixed size, which lose what does not fit, and a
//! directory of where the photons of each cell are.

use super::leaves::Point;
use super::{AccessObserver, BuildError, Nearest, PhotonMap, check, distance_squared, extent};
use pm_formats::Photon;
use pm_formats::trace::{Coding, Region, lay_out};

/// Photons for each cell of the grid, on average over all cells, most of which are empty.
const PHOTONS_PER_CELL: usize = 4;

/// What fixed cells have room for unless asked, at most, in multiples of the photons there are.
const MOST_SLOTS: usize = 16;

/// Bytes of a fixed cell that say how many photons it holds.
const HEADER: u32 = 8;
/// Bytes of a directory entry: where a cell's photons begin, and how many there are.
const ENTRY: u32 = 8;

/// How photons are found from a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// By the cell's number: every cell has room for as many photons, and more are lost.
    Fixed {
        /// Bytes in which a cell is read: the first line says how many photons there are.
        line: u32,
        /// Photons a cell has room for; `None` for twice what a cell that is not empty holds on average, rounded up to
        /// fill its last line.
        slots: Option<u32>,
    },
    /// Through a directory.
    Indirect,
}

/// The grid: cubes of one size over the photons' bounds.
pub struct Grid {
    origin: [f64; 3],
    side: f64,
    counts: [usize; 3],
    /// Where each cell's photons begin; one more than cells.
    starts: Vec<u32>,
    /// By cell, and by id in each.
    points: Vec<Point>,
    /// Bytes of a fixed cell and of its lines.
    fixed: Option<(u32, u32)>,
    lost: usize,
    photons: usize,
}

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
            let photon = size_of::<Photon>() as u32;
            let cells = counts.iter().product::<usize>();
            let most = MOST_SLOTS * photons.len() / cells;
            let wanted = wanted.map_or((2 * photons.len()).div_ceil(occupied).min(most).max(1), |slots| slots as usize);
            let bytes = (u64::from(HEADER) + wanted as u64 * u64::from(photon)).next_multiple_of(u64::from(line));
            let lines = cells as u64 * (bytes / u64::from(line));
            let bytes =
                u32::try_from(bytes).ok().filter(|_| lines <= u64::from(u32::MAX)).ok_or(BuildError::TooLarge)?;
            slots = ((bytes - HEADER) / photon) as usize;
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

    /// Photons that found no room in their cell.
    #[must_use]
    pub const fn lost(&self) -> usize {
        self.lost
    }

    /// Number of cells along each axis.
    #[must_use]
    pub const fn cells(&self) -> [usize; 3] {
        self.counts
    }

    /// The nearest cell along an axis.
    #[inline]
    fn along(&self, axis: usize, x: f32) -> usize {
        let cell = (f64::from(x) - self.origin[axis]) / self.side;
        // Negative numbers become 0, as NaN does.
        (cell as usize).min(self.counts[axis] - 1)
    }

    fn cell(&self, position: [f32; 3]) -> u32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.along(axis, position[axis]));
        ((z * self.counts[1] + y) * self.counts[0] + x) as u32
    }

    /// How far a point lies outside the cells `from..=to` along an axis, and a little less, since photons are sorted into
    /// cells by rounded numbers.
    #[inline]
    fn beyond(&self, axis: usize, x: f32, from: usize, to: usize) -> f64 {
        let x = f64::from(x) - self.origin[axis];
        let slack = 1e-12 * (self.origin[axis].abs() + self.side * self.counts[axis] as f64);
        ((from as f64 * self.side - x).max(x - (to + 1) as f64 * self.side) - slack).max(0.0)
    }

    /// Reads a cell and shows its photons.
    #[inline]
    fn visit(&self, cell: usize, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        let (start, end) = (self.starts[cell], self.starts[cell + 1]);
        match self.fixed {
            Some((bytes, line)) => {
                let used = HEADER + (end - start) * size_of::<Photon>() as u32;
                let first = cell as u32 * (bytes / line);
                (first..first + used.div_ceil(line)).for_each(|record| eyes.read(0, record));
            }
            None => {
                eyes.read(0, cell as u32);
                (start..end).for_each(|record| eyes.read(1, record));
            }
        }
        eyes.examined((end - start) as usize);
        for stored in &self.points[start as usize..end as usize] {
            found.show(distance_squared(point, stored.position), stored.id);
        }
    }
}

/// The smallest cubes of which `most` cover a box, and how many of them along each side.
fn cubes(extents: [f64; 3], most: usize) -> (f64, [usize; 3]) {
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

/// A squared distance as maps compute it would not be less, whatever was rounded away on the way.
#[expect(clippy::cast_possible_truncation, reason = "rounded as squared distances are")]
fn at_least(distance_squared: f64) -> f32 {
    (distance_squared * (1.0 - 1e-6) - 1e-44).max(0.0) as f32
}

impl PhotonMap for Grid {
    fn regions(&self, _: bool) -> Vec<Region> {
        let cells = self.starts.len() as u64 - 1;
        let photon = size_of::<Photon>() as u32;
        match self.fixed {
            Some((bytes, line)) => lay_out([("cells".into(), cells * u64::from(bytes), line, Coding::Records)]),
            None => lay_out([
                ("cell directory".into(), cells * u64::from(ENTRY), ENTRY, Coding::Records),
                ("photons".into(), self.points.len() as u64 * u64::from(photon), photon, Coding::Records),
            ]),
        }
    }

    fn len(&self) -> usize {
        self.photons
    }

    fn is_exact(&self) -> bool {
        self.lost == 0
    }

    /// The query's own cell, then shell after shell of cells about it, until no photon in the next can be near enough.
    fn nearest(&self, point: [f32; 3], found: &mut Nearest, eyes: &mut impl AccessObserver) {
        let centre = [0, 1, 2].map(|axis| self.along(axis, point[axis]));
        let widest = (0..3).map(|axis| centre[axis].max(self.counts[axis] - 1 - centre[axis])).max().unwrap_or(0);
        for shell in 0..=widest {
            let from = centre.map(|cell| cell.saturating_sub(shell));
            let to = [0, 1, 2].map(|axis| (centre[axis] + shell).min(self.counts[axis] - 1));
            let mut reached = false;
            for z in from[2]..=to[2] {
                let dz = self.beyond(2, point[2], z, z);
                for y in from[1]..=to[1] {
                    let dy = self.beyond(1, point[1], y, y);
                    let inside = z.abs_diff(centre[2]) < shell && y.abs_diff(centre[1]) < shell;
                    let mut x = from[0];
                    while x <= to[0] {
                        if inside && x.abs_diff(centre[0]) < shell {
                            // Rows within the shell before have only their two ends here.
                            x = centre[0] + shell;
                            continue;
                        }
                        let dx = self.beyond(0, point[0], x, x);
                        if at_least(dx * dx + dy * dy + dz * dz) <= found.bound() {
                            reached = true;
                            self.visit((z * self.counts[1] + y) * self.counts[0] + x, point, found, eyes);
                        }
                        x += 1;
                    }
                }
            }
            // Every way outward leads through this shell.
            if !reached {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn photons(positions: impl IntoIterator<Item = [f32; 3]>) -> Vec<Photon> {
        let up = [0.0, 1.0, 0.0];
        positions.into_iter().map(|p| Photon::new(p, [1.0; 3], [0.5; 3], up, up).unwrap()).collect()
    }

    #[test]
    fn cubes_are_as_many_as_asked_or_a_little_fewer() {
        for extents in [[1.0; 3], [1.0, 1.0, 0.0], [1e6, 0.0, 0.0], [1e6, 1e-6, 1e-6], [1e-40; 3], [3.0, 2.0, 0.5]] {
            for most in [1, 2, 10, 1000, 100_000] {
                let (side, [x, y, z]) = cubes(extents, most);
                assert!(x * y * z <= most && x * y * z * 30 >= most, "{extents:?} {most}: {side} {x} {y} {z}");
            }
        }
    }

    #[test]
    fn fixed_cells_lose_what_has_no_room_and_say_so() {
        // A hundred photons in one spot, and one far away so that there are cells.
        let list = photons((0..100).map(|_| [0.0; 3]).chain([[1.0; 3]]));
        let grid = Grid::build(&list, Cells::Fixed { line: 128, slots: Some(6) }).unwrap();
        assert_eq!((grid.lost(), grid.points.len(), grid.is_exact()), (94, 7, false));
        let roomy = Grid::build(&list, Cells::Fixed { line: 128, slots: Some(100) }).unwrap();
        assert_eq!((roomy.lost(), roomy.is_exact()), (0, true));
        let mut found = Nearest::new(101, f32::INFINITY);
        grid.nearest([0.0; 3], &mut found, &mut super::super::Blind);
        assert_eq!(found.len(), 7);
    }

    #[test]
    fn a_fixed_cell_is_read_as_far_as_it_is_used() {
        let grid = Grid::build(&photons([[0.0; 3]; 3]), Cells::Fixed { line: 32, slots: Some(9) }).unwrap();
        // 8 + 9 x 20 bytes are six lines; 8 + 3 x 20 bytes reach into the third.
        assert_eq!(grid.regions(false)[0].size, 192);
        let mut reads = 0u64;
        grid.nearest([0.0; 3], &mut Nearest::new(1, f32::INFINITY), &mut reads);
        assert_eq!(reads, 3);
    }
}
