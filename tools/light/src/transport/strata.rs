//! The strata of a hemisphere: a grid in elevation and azimuth with a ray in each, and the bins they are put into.

use super::sampling::grid;
use pm_random::Random;

pm_registry::choices! {
    /// In which order the strata of a hemisphere are visited; the rays are the same.
    #[derive(Debug)]
    pub enum Strata {
        /// Ring by ring: elevation outer, azimuth inner
        Raster = "raster",
        /// Another random order for each point
        Shuffled = "shuffled",
    }
}

/// So many strata, numbered ring by ring, each in one bin.
pub(super) struct StrataGrid {
    rows: u32,
    columns: u32,
    /// Row and column of each stratum.
    cells: Vec<[f32; 2]>,
    /// The strata of each bin, in raster order.
    bins: Vec<Vec<u32>>,
}

impl StrataGrid {
    /// `strata` of them, all in one bin.
    pub(super) fn new(strata: u32) -> Self {
        let (rows, columns) = grid(strata.max(1));
        let cells = (0..strata).map(|stratum| [(stratum / columns) as f32, (stratum % columns) as f32]).collect();
        Self { rows, columns, cells, bins: vec![(0..strata).collect()] }
    }

    /// The same in so many bins, a grid in elevation and azimuth as well. A stratum belongs to the bin that holds its lower
    /// corner, so some bins are empty if there are more than strata.
    pub(super) fn with_bins(self, bins: u32) -> Self {
        let Self { rows, columns, cells, .. } = self;
        let (bin_rows, bin_columns) = grid(bins.max(1));
        let mut of_bin = vec![vec![]; bins.max(1) as usize];
        for stratum in self.bins.into_iter().flatten() {
            let part = |at: u32, of: u32, bins: u32| u64::from(at) * u64::from(bins) / u64::from(of);
            let row = part(stratum / columns, rows, bin_rows);
            let column = part(stratum % columns, columns, bin_columns);
            of_bin[(row * u64::from(bin_columns) + column) as usize].push(stratum);
        }
        Self { rows, columns, cells, bins: of_bin }
    }

    /// Strata of elevation and of azimuth.
    pub(super) const fn shape(&self) -> (u32, u32) {
        (self.rows, self.columns)
    }

    /// The strata of a bin, in raster order.
    pub(super) fn of_bin(&self, bin: u32) -> &[u32] {
        &self.bins[bin as usize]
    }

    /// Number of bins.
    pub(super) const fn bins(&self) -> usize {
        self.bins.len()
    }

    /// Number of strata in each bin.
    pub(super) fn bin_sizes(&self) -> impl Iterator<Item = u64> {
        self.bins.iter().map(|strata| strata.len() as u64)
    }

    /// A random point of a stratum in the unit square: elevation from the normal outward, and azimuth.
    #[inline]
    pub(super) fn point(&self, stratum: u32, random: &mut Random) -> (f32, f32) {
        let [row, column] = self.cells[stratum as usize];
        let u = (row + random.unit()) / self.rows as f32;
        let v = (column + random.unit()) / self.columns as f32;
        (u.min(1.0), v)
    }
}
