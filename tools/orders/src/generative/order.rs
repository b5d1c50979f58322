//! What a generative order is.

use super::pass::{Pass, VisiblePoints};
use pm_formats::vocabulary::OrderLabel;
use pm_registry::{ParameterError, Registered, Values};
use std::ops::Range;
use std::sync::Arc;

/// A generative order that can be chosen by its word.
pub trait GenerativeOrder: Registered + Sync {
    /// The order that is asked for with these values, where each point seen sends gather rays through so many strata of its
    /// hemisphere (1 if it sends none).
    ///
    /// # Errors
    /// If the values do not go together, or not with the strata.
    fn make(&self, values: &Values, strata: u32) -> Result<Box<dyn Generative>, ParameterError>;
}

/// An order in which queries are generated: which pixel comes next, and which of its rays.
pub trait Generative: Send + Sync {
    /// What headers call it.
    fn label(&self) -> OrderLabel;

    /// The pixels of an image of this width and height, batch by batch: every pixel in one batch, once.
    fn batches(&self, size: [u32; 2]) -> Box<dyn Iterator<Item = Vec<PixelRun>> + '_>;

    /// Number of batches of an image.
    fn batch_count(&self, size: [u32; 2]) -> u64 {
        self.batches(size).count() as u64
    }

    /// The passes over each batch, in order: together they cast every ray once, as those of [`every_ray`](Pass::every_ray)
    /// do.
    fn passes(&self) -> Vec<Pass> {
        Pass::every_ray(&[VisiblePoints::All], 1)
    }
}

/// Pixels of one row, next to each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PixelRun {
    /// The row.
    pub row: u32,
    /// The columns.
    pub columns: Range<u32>,
}

/// Pixels of one row that are cast together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// The batch that their queries belong to, counted from 0.
    pub batch: u64,
    /// The row.
    pub row: u32,
    /// The columns.
    pub columns: Range<u32>,
    /// Which rays of these pixels are cast.
    pub pass: Pass,
}

impl dyn Generative + '_ {
    /// The pixels of an image, in order: batch by batch, all passes over each.
    pub fn spans(&self, size: [u32; 2]) -> Box<dyn Iterator<Item = Span> + '_> {
        let passes: Arc<[Pass]> = self.passes().into();
        let spans = (0..).zip(self.batches(size)).flat_map(move |(batch, runs)| {
            let runs: Arc<[PixelRun]> = runs.into();
            let passes = passes.clone();
            (0..passes.len() * runs.len()).map(move |at| {
                let PixelRun { row, columns } = runs[at % runs.len()].clone();
                Span { batch, row, columns, pass: passes[at / runs.len()] }
            })
        });
        Box::new(spans)
    }

    /// Number of bins that the hemisphere is divided into.
    #[must_use]
    pub fn bins(&self) -> u32 {
        self.passes().iter().map(|pass| pass.bin + 1).max().unwrap_or(1)
    }
}
