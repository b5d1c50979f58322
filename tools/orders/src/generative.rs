//! Generative orders: in which order a picture's pixels are visited.
//!
//! Steinhurst, Coombe, Lastra, GI 2005, section 3.1.

use pm_formats::vocabulary::OrderLabel;
use std::fmt;
use std::ops::Range;

/// An order in which queries are generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Generative {
    /// Row by row: the paper's naive order. A row is a batch.
    Scanline,
    /// Square tiles, row by row, and the pixels of each row by row. A tile is a batch; what is seen in mirrors and through
    /// glass waits until all else of the tile is done.
    Tiled {
        /// Width and height in pixels; tiles at the right and lower edge may be smaller.
        tile: u32,
    },
    /// As tiled, with a pass over the tile's pixels for each bin of the hemisphere: rays that leave neighbouring points
    /// in like directions follow one another. Then the same for what is seen in mirrors and through glass.
    DirectionBinned {
        /// Width and height in pixels.
        tile: u32,
        /// Bins that the strata of a hemisphere are put into.
        bins: u32,
    },
}

/// Which of a pixel's points seen are gathered for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VisiblePoints {
    /// All, in the order in which they are found.
    All,
    /// Only those seen directly.
    Direct,
    /// Only those seen in mirrors and through glass.
    BehindSpecular,
}

impl VisiblePoints {
    /// Is a point among them that is seen in mirrors or through glass, or else one that is seen directly?
    #[must_use]
    pub const fn include(self, behind_specular: bool) -> bool {
        match self {
            Self::All => true,
            Self::Direct => !behind_specular,
            Self::BehindSpecular => behind_specular,
        }
    }
}

/// What of a pixel's gather rays is cast at one visit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// From which points seen.
    pub points: VisiblePoints,
    /// Into which bin of the hemisphere, counted from 0.
    pub bin: u32,
}

impl Pass {
    /// Is it a pixel's first visit?
    #[must_use]
    pub fn is_first(self) -> bool {
        self.points != VisiblePoints::BehindSpecular && self.bin == 0
    }
}

/// All directions, where there are no bins.
impl From<VisiblePoints> for Pass {
    fn from(points: VisiblePoints) -> Self {
        Self { points, bin: 0 }
    }
}

/// Pixels of one row that are cast together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// The batch that their queries belong to.
    pub batch: u64,
    /// The row.
    pub row: u32,
    /// The columns.
    pub columns: Range<u32>,
    /// Which rays of these pixels are cast.
    pub pass: Pass,
}

impl Generative {
    /// The pixels of an image, in order.
    pub fn spans(self, [width, height]: [u32; 2]) -> Box<dyn Iterator<Item = Span>> {
        match self {
            Self::Scanline => Box::new((0..height).map(move |row| Span {
                batch: row.into(),
                row,
                columns: 0..width,
                pass: VisiblePoints::All.into(),
            })),
            Self::Tiled { tile } | Self::DirectionBinned { tile, .. } => self.tiles(tile, [width, height]),
        }
    }

    /// The passes over each batch, in order.
    pub fn passes(self) -> impl Iterator<Item = Pass> + Clone {
        let (points, bins): (&[VisiblePoints], u32) = match self {
            Self::Scanline => (&[VisiblePoints::All], 1),
            Self::Tiled { .. } => (&POINTS_OF_A_TILE, 1),
            Self::DirectionBinned { bins, .. } => (&POINTS_OF_A_TILE, bins),
        };
        points.iter().flat_map(move |&points| (0..bins).map(move |bin| Pass { points, bin }))
    }

    /// Number of batches of an image.
    #[must_use]
    pub fn batches(self, [width, height]: [u32; 2]) -> u64 {
        match self {
            Self::Scanline => height.into(),
            Self::Tiled { tile } | Self::DirectionBinned { tile, .. } => {
                u64::from(width.div_ceil(tile)) * u64::from(height.div_ceil(tile))
            }
        }
    }

    /// Number of bins that the hemisphere is divided into.
    #[must_use]
    pub const fn bins(self) -> u32 {
        match self {
            Self::Scanline | Self::Tiled { .. } => 1,
            Self::DirectionBinned { bins, .. } => bins,
        }
    }

    /// Tile by tile, all passes over each.
    fn tiles(self, tile: u32, [width, height]: [u32; 2]) -> Box<dyn Iterator<Item = Span>> {
        let (across, down) = (width.div_ceil(tile), height.div_ceil(tile));
        let tiles = (0..down).flat_map(move |y| (0..across).map(move |x| (x, y)));
        Box::new((0..).zip(tiles).flat_map(move |(batch, (x, y))| {
            let columns = x * tile..(x.saturating_add(1)).saturating_mul(tile).min(width);
            let rows = y * tile..(y.saturating_add(1)).saturating_mul(tile).min(height);
            self.passes().flat_map(move |pass| {
                let columns = columns.clone();
                rows.clone().map(move |row| Span { batch, row, columns: columns.clone(), pass })
            })
        }))
    }
}

/// In a tile, what is seen directly, and then what is seen in mirrors and through glass.
const POINTS_OF_A_TILE: [VisiblePoints; 2] = [VisiblePoints::Direct, VisiblePoints::BehindSpecular];

impl fmt::Display for Generative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let label = match *self {
            Self::Scanline => OrderLabel::new("scanline"),
            Self::Tiled { tile } => OrderLabel { tile: Some([tile; 2]), ..OrderLabel::new("tiled") },
            Self::DirectionBinned { tile, bins } => {
                OrderLabel { tile: Some([tile; 2]), bins: Some(bins), ..OrderLabel::new("direction-binned") }
            }
        };
        label.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn every_pixel_is_visited_once_in_each_pass() {
        for size in [[1, 1], [7, 5], [16, 16], [33, 17]] {
            for order in [
                Generative::Scanline,
                Generative::Tiled { tile: 1 },
                Generative::Tiled { tile: 16 },
                Generative::DirectionBinned { tile: 1, bins: 3 },
                Generative::DirectionBinned { tile: 16, bins: 4 },
                Generative::DirectionBinned { tile: u32::MAX, bins: 1 },
            ] {
                let mut visits: BTreeMap<(bool, u32, u32, u32), u32> = BTreeMap::new();
                let mut first_visits = 0;
                let mut last_batch = 0;
                for span in order.spans(size) {
                    assert!(span.batch >= last_batch);
                    last_batch = span.batch;
                    first_visits += if span.pass.is_first() { span.columns.len() } else { 0 };
                    for x in span.columns {
                        let specular = span.pass.points == VisiblePoints::BehindSpecular;
                        *visits.entry((specular, span.pass.bin, span.row, x)).or_default() += 1;
                    }
                }
                assert_eq!(first_visits as u32, size[0] * size[1]);
                let passes = if order == Generative::Scanline { 1 } else { 2 * order.bins() };
                assert_eq!(visits.len() as u32, passes * size[0] * size[1], "{order} {size:?}");
                assert!(visits.values().all(|&n| n == 1));
            }
        }
    }

    #[test]
    fn a_tile_is_finished_before_the_next_begins_and_specular_comes_last() {
        let spans: Vec<_> = Generative::Tiled { tile: 2 }.spans([4, 2]).collect();
        let order: Vec<_> =
            spans.iter().map(|span| (span.batch, span.row, span.columns.start, span.pass.is_first())).collect();
        assert_eq!(order[..4], [(0, 0, 0, true), (0, 1, 0, true), (0, 0, 0, false), (0, 1, 0, false)]);
        assert_eq!(order[4], (1, 0, 2, true));
    }

    #[test]
    fn a_bin_of_all_pixels_of_a_tile_comes_before_the_next_bin() {
        let order = Generative::DirectionBinned { tile: 2, bins: 2 };
        let passes: Vec<_> =
            order.spans([4, 2]).map(|span| (span.batch, span.pass.points, span.pass.bin, span.row)).collect();
        let (direct, behind) = (VisiblePoints::Direct, VisiblePoints::BehindSpecular);
        assert_eq!(passes[..4], [(0, direct, 0, 0), (0, direct, 0, 1), (0, direct, 1, 0), (0, direct, 1, 1)]);
        assert_eq!(passes[4..8], [(0, behind, 0, 0), (0, behind, 0, 1), (0, behind, 1, 0), (0, behind, 1, 1)]);
        assert_eq!(passes[8], (1, direct, 0, 0));
    }

    #[test]
    fn the_largest_tile_is_the_image() {
        assert_eq!(Generative::Tiled { tile: u32::MAX }.spans([3, 3]).map(|span| span.batch).max(), Some(0));
    }
}
