//! Tile by tile.

use super::order::{Generative, GenerativeOrder, PixelRun};
use super::pass::{Pass, VisiblePoints};
use pm_formats::vocabulary::OrderLabel;
use pm_registry::{Domain, Parameter, ParameterError, Registered as _, Values, registered};

registered! {
    /// Square tiles, each in scanline order and a batch; what is seen by reflection or refraction comes last in each
    pub struct Tiled = "tiled" with [TILE];
}

/// The side of a tile.
pub(super) const TILE: Parameter =
    Parameter::new("tile", Domain::count(1, u32::MAX as u64), "side of a tile in pixels").or("16").called("PIXELS");

/// In a tile, what is seen directly, and then what is seen in mirrors and through glass.
pub(super) const POINTS_OF_A_TILE: [VisiblePoints; 2] = [VisiblePoints::Direct, VisiblePoints::BehindSpecular];

/// Tiles, row by row, and the pixels of each row by row.
#[derive(Clone, Copy)]
pub(super) struct Tiles {
    /// Width and height in pixels; tiles at the right and lower edge may be smaller.
    side: u32,
}

impl GenerativeOrder for Tiled {
    fn make(&self, values: &Values, _: u32) -> Result<Box<dyn Generative>, ParameterError> {
        Ok(Box::new(Tiles::new(values)))
    }
}

impl Tiles {
    /// Tiles of the side that is asked for.
    pub(super) fn new(values: &Values) -> Self {
        Self { side: values.count(TILE.name) }
    }

    /// Width and height in pixels.
    pub(super) const fn size(self) -> [u32; 2] {
        [self.side, self.side]
    }
}

impl Generative for Tiles {
    fn label(&self) -> OrderLabel {
        OrderLabel { tile: Some(self.size()), ..OrderLabel::new(Tiled.word()) }
    }

    fn batches(&self, [width, height]: [u32; 2]) -> Box<dyn Iterator<Item = Vec<PixelRun>> + '_> {
        let side = self.side;
        let part = move |at: u32, of: u32| at * side..at.saturating_add(1).saturating_mul(side).min(of);
        let (across, down) = (width.div_ceil(side), height.div_ceil(side));
        let tiles = (0..down).flat_map(move |y| (0..across).map(move |x| (x, y)));
        Box::new(tiles.map(move |(x, y)| {
            let run = |row| PixelRun { row, columns: part(x, width) };
            part(y, height).map(run).collect()
        }))
    }

    fn batch_count(&self, [width, height]: [u32; 2]) -> u64 {
        u64::from(width.div_ceil(self.side)) * u64::from(height.div_ceil(self.side))
    }

    fn passes(&self) -> Vec<Pass> {
        Pass::every_ray(&POINTS_OF_A_TILE, 1)
    }
}
