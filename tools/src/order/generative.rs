//! Generative orders: in which order a picture's pixels are visited.
//!
//! Steinhurst, Coombe, Lastra, GI 2005, section 3.1.

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
}

/// Which of a pixel's points seen are gathered for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaves {
    /// All, in the order in which they are found.
    All,
    /// Only those seen directly.
    Direct,
    /// Only those seen in mirrors and through glass.
    BehindSpecular,
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
    /// Which points seen in these pixels are gathered for.
    pub leaves: Leaves,
    /// False for a second visit to the same pixels.
    pub first_pass: bool,
}

impl Generative {
    /// The pixels of an image, in order.
    pub fn spans(self, [width, height]: [u32; 2]) -> Box<dyn Iterator<Item = Span>> {
        match self {
            Self::Scanline => Box::new((0..height).map(move |row| Span {
                batch: row.into(),
                row,
                columns: 0..width,
                leaves: Leaves::All,
                first_pass: true,
            })),
            Self::Tiled { tile } => {
                let (across, down) = (width.div_ceil(tile), height.div_ceil(tile));
                let tiles = (0..down).flat_map(move |y| (0..across).map(move |x| (x, y)));
                Box::new((0..).zip(tiles).flat_map(move |(batch, (x, y))| {
                    let columns = x * tile..(x.saturating_add(1)).saturating_mul(tile).min(width);
                    let rows = y * tile..(y.saturating_add(1)).saturating_mul(tile).min(height);
                    [Leaves::Direct, Leaves::BehindSpecular].into_iter().flat_map(move |leaves| {
                        let columns = columns.clone();
                        rows.clone().map(move |row| Span {
                            batch,
                            row,
                            columns: columns.clone(),
                            leaves,
                            first_pass: leaves == Leaves::Direct,
                        })
                    })
                }))
            }
        }
    }
}

impl fmt::Display for Generative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scanline => f.write_str("scanline"),
            Self::Tiled { tile } => write!(f, "tiled {tile}x{tile}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn every_pixel_is_visited_once_in_each_pass() {
        for size in [[1, 1], [7, 5], [16, 16], [33, 17]] {
            for order in [Generative::Scanline, Generative::Tiled { tile: 1 }, Generative::Tiled { tile: 16 }] {
                let mut visits: BTreeMap<(bool, u32, u32), u32> = BTreeMap::new();
                let mut last_batch = 0;
                for span in order.spans(size) {
                    assert!(span.batch >= last_batch);
                    last_batch = span.batch;
                    for x in span.columns {
                        *visits.entry((span.leaves == Leaves::BehindSpecular, span.row, x)).or_default() += 1;
                    }
                }
                let passes = if order == Generative::Scanline { 1 } else { 2 };
                assert_eq!(visits.len() as u32, passes * size[0] * size[1], "{order} {size:?}");
                assert!(visits.values().all(|&n| n == 1));
            }
        }
    }

    #[test]
    fn a_tile_is_finished_before_the_next_begins_and_specular_comes_last() {
        let spans: Vec<_> = Generative::Tiled { tile: 2 }.spans([4, 2]).collect();
        let order: Vec<_> =
            spans.iter().map(|span| (span.batch, span.row, span.columns.start, span.first_pass)).collect();
        assert_eq!(order[..4], [(0, 0, 0, true), (0, 1, 0, true), (0, 0, 0, false), (0, 1, 0, false)]);
        assert_eq!(order[4], (1, 0, 2, true));
    }

    #[test]
    fn the_largest_tile_is_the_image() {
        assert_eq!(Generative::Tiled { tile: u32::MAX }.spans([3, 3]).map(|span| span.batch).max(), Some(0));
    }
}
