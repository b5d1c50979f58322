//! Which windows of a stream are measured: one in each of many strata, by chance.
//!
//! The stream is cut into cells of equal length and these into strata of consecutive cells; in each stratum one cell is
//! chosen, all of them with the same chance. So a period of the stream (a scanline, a hemisphere, a tile) never falls in
//! with a step of the sample, and no two windows overlap in what they measure. Cochran, *Sampling Techniques*, third
//! edition, 1977, chapter 8, compares it with a fixed step.

use pm_random::Random;
use std::ops::Range;

/// One cell of `cells` in each of `strata` strata, whose sizes differ by at most one cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StratifiedCells {
    cells: u64,
    strata: u64,
    seed: u64,
}

impl StratifiedCells {
    /// As many windows as there are strata; `None` if there are more of these than cells, or none.
    #[must_use]
    pub const fn new(cells: u64, strata: u64, seed: u64) -> Option<Self> {
        if strata == 0 || strata > cells { None } else { Some(Self { cells, strata, seed }) }
    }

    /// The cells that are chosen, in order: one for each stratum.
    pub fn cells(self) -> impl Iterator<Item = u64> {
        let first = move |stratum: u64| {
            let product = u128::from(stratum) * u128::from(self.cells);
            // At most the number of cells.
            (product / u128::from(self.strata)) as u64
        };
        (0..self.strata).map(move |stratum| {
            let start = first(stratum);
            start + chosen(self.seed, stratum, first(stratum + 1) - start)
        })
    }
}

/// One window in each `every` records of a stream whose length need not be known.
///
/// Where the stream ends within a stratum, the window is chosen as in any other, and so much of it is there as the stream
/// holds, perhaps nothing: every record has the same chance to be measured, the last ones as well.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StratifiedStream {
    every: u64,
    window: u64,
    seed: u64,
}

impl StratifiedStream {
    /// Windows of `window` records; `None` if `every` is not a multiple of it, which chances that are equal need.
    #[must_use]
    pub const fn new(every: u64, window: u64, seed: u64) -> Option<Self> {
        if window == 0 || every < window || !every.is_multiple_of(window) {
            None
        } else {
            Some(Self { every, window, seed })
        }
    }

    /// The records that are measured of a stratum, by their places in the stream.
    #[must_use]
    pub fn window(self, stratum: u64) -> Range<u64> {
        let cell = chosen(self.seed, stratum, self.every / self.window);
        let start = stratum.saturating_mul(self.every).saturating_add(cell * self.window);
        start..start.saturating_add(self.window)
    }
}

/// The share of a stream of `records` that lies in the cell `cell` of `length` each; the last one may be shorter.
#[must_use]
pub fn cell_of(cell: u64, length: u64, records: u64) -> Range<u64> {
    cell.saturating_mul(length).min(records)..(cell + 1).saturating_mul(length).min(records)
}

/// A number below `cells` that belongs to the stratum.
fn chosen(seed: u64, stratum: u64, cells: u64) -> u64 {
    // The high half of the product: even but for one part in 2^64 / cells.
    ((u128::from(Random::new(&[seed, stratum]).next_u64()) * u128::from(cells)) >> 64) as u64
}

#[cfg(test)]
mod tests;
