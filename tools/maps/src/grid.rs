//! The uniform grid, in the two forms that GI'05 looked at: cells of fixed size, which lose what does not fit, and a
//! directory of where the photons of each cell are.

mod build;

use super::geometry::distance_squared;
use super::point::Point;
use super::{AccessObserver, Nearest, PhotonMap};
use pm_formats::trace::{Coding, Region, Waits, lay_out};
use pm_formats::{Number, Photon};

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
                // Cells lie where the query says; how far one is filled stands in its first record.
                eyes.read_after(0, first, Waits::NOTHING);
                let rest = first + 1..first + used.div_ceil(line);
                rest.for_each(|record| eyes.read_after(0, record, Waits::last_above(1)));
            }
            None => {
                eyes.read_after(0, cell as u32, Waits::NOTHING);
                (start..end).for_each(|record| eyes.read_after(1, record, Waits::last_above(1)));
            }
        }
        eyes.examined((end - start) as usize);
        for stored in &self.points[start as usize..end as usize] {
            found.show(distance_squared(point, stored.position), stored.id);
        }
    }
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
                ("cell directory".into(), cells * u64::from(ENTRY), ENTRY, Coding::InTurns),
                ("photons".into(), self.points.len() as u64 * u64::from(photon), photon, Coding::InTurns),
            ]),
        }
    }

    fn len(&self) -> usize {
        self.photons
    }

    fn is_exact(&self) -> bool {
        self.lost == 0
    }

    fn tells_waits(&self) -> bool {
        true
    }

    fn measures(&self) -> Vec<(&'static str, Number)> {
        let cells = self.counts.iter().product::<usize>();
        vec![("cells", Number::Count(cells as u64)), ("photons_lost", Number::Count(self.lost as u64))]
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
mod tests;
