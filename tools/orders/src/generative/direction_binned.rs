//! Tile by tile, and in each by the direction of the gather rays.

use super::order::{Generative, GenerativeOrder, PixelRun};
use super::pass::Pass;
use super::tiled::{POINTS_OF_A_TILE, TILE, Tiles};
use pm_formats::vocabulary::OrderLabel;
use pm_registry::{Domain, Parameter, ParameterError, Registered as _, Values, registered};

registered! {
    /// As tiled, with a pass over each tile for every bin of the hemisphere
    pub struct DirectionBinned = "direction-binned" with [TILE, BINS];
}

/// Bins that the strata of a hemisphere are put into.
const BINS: Parameter = Parameter::new(
    "bins",
    Domain::count(1, u32::MAX as u64),
    "bins of the hemisphere, at most as many as --gathers; default: as many",
)
.hidden();

/// Rays that leave neighbouring points in like directions follow one another. Then the same for what is seen in mirrors and
/// through glass.
struct BinnedTiles {
    tiles: Tiles,
    bins: u32,
}

impl GenerativeOrder for DirectionBinned {
    fn make(&self, values: &Values, strata: u32) -> Result<Box<dyn Generative>, ParameterError> {
        let bins = values.count_if_any(BINS.name).unwrap_or(strata);
        if bins > strata {
            let what = format!("--bins {bins} is more than the {strata} strata: give at most {strata}");
            return Err(ParameterError::Unfit(what));
        }
        Ok(Box::new(BinnedTiles { tiles: Tiles::new(values), bins }))
    }
}

impl Generative for BinnedTiles {
    fn label(&self) -> OrderLabel {
        OrderLabel { tile: Some(self.tiles.size()), bins: Some(self.bins), ..OrderLabel::new(DirectionBinned.word()) }
    }

    fn batches(&self, size: [u32; 2]) -> Box<dyn Iterator<Item = Vec<PixelRun>> + '_> {
        self.tiles.batches(size)
    }

    fn batch_count(&self, size: [u32; 2]) -> u64 {
        self.tiles.batch_count(size)
    }

    fn passes(&self) -> Vec<Pass> {
        Pass::every_ray(&POINTS_OF_A_TILE, self.bins)
    }
}
