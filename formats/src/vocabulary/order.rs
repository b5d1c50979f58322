//! Orders of queries, as headers name them.

use super::UnknownText;
use std::fmt;
use std::str::FromStr;

/// The order in which queries were made: the value of [`ORDER`](super::meaning::ORDER), such as `scanline`, `tiled 16x16`
/// or `direction-binned 16x16, bins 4`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OrderLabel {
    /// The order's word.
    pub word: String,
    /// Width and height in pixels of the tiles that are its batches, if they are tiles.
    pub tile: Option<[u32; 2]>,
    /// Bins of the hemisphere, with a pass over each tile for each, if there are any.
    pub bins: Option<u32>,
}

impl OrderLabel {
    /// An order that goes by nothing but its word.
    #[must_use]
    pub fn new(word: &str) -> Self {
        Self { word: word.to_owned(), tile: None, bins: None }
    }

    /// Pixels of a batch, if each is a tile.
    #[must_use]
    pub fn tile_pixels(&self) -> Option<u64> {
        self.tile.map(|[width, height]| u64::from(width) * u64::from(height))
    }
}

impl fmt::Display for OrderLabel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.word)?;
        if let Some([width, height]) = self.tile {
            write!(f, " {width}x{height}")?;
        }
        self.bins.map_or(Ok(()), |bins| write!(f, ", bins {bins}"))
    }
}

impl FromStr for OrderLabel {
    type Err = UnknownText;

    fn from_str(text: &str) -> Result<Self, UnknownText> {
        let parsed = || {
            let (order, bins) = match text.split_once(", bins ") {
                Some((order, bins)) => (order, Some(bins.parse().ok()?)),
                None => (text, None),
            };
            let (word, tile) = match order.split_once(' ') {
                Some((word, tile)) => {
                    let (width, height) = tile.split_once('x')?;
                    (word, Some([width.parse().ok()?, height.parse().ok()?]))
                }
                None => (order, None),
            };
            (!word.is_empty()).then(|| Self { word: word.to_owned(), tile, bins })
        };
        parsed().ok_or_else(|| UnknownText { what: "order such as `tiled 16x16`", text: text.to_owned() })
    }
}

/// The order that queries were put into after they were made: the value of
/// [`DEFERRED_ORDER`](super::meaning::DEFERRED_ORDER), such as `hilbert` or `snowplow 1M per batch compact`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeferredLabel {
    /// The order's word, and what its result depends on.
    pub order: String,
    /// Each batch was ordered by itself.
    pub per_batch: bool,
    /// A compact record of each query was stored while it waited.
    pub compact: bool,
}

/// How [`DeferredLabel`] says that batches were ordered by themselves, and that records are compact.
const PER_BATCH: &str = " per batch";
const COMPACT: &str = " compact";

impl fmt::Display for DeferredLabel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let per_batch = if self.per_batch { PER_BATCH } else { "" };
        let compact = if self.compact { COMPACT } else { "" };
        write!(f, "{}{per_batch}{compact}", self.order)
    }
}

impl FromStr for DeferredLabel {
    type Err = UnknownText;

    fn from_str(text: &str) -> Result<Self, UnknownText> {
        let (rest, compact) = text.strip_suffix(COMPACT).map_or((text, false), |rest| (rest, true));
        let (order, per_batch) = rest.strip_suffix(PER_BATCH).map_or((rest, false), |order| (order, true));
        if order.is_empty() {
            return Err(UnknownText { what: "order such as `hilbert per batch`", text: text.to_owned() });
        }
        Ok(Self { order: order.to_owned(), per_batch, compact })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_are_read_as_they_are_written() {
        let tiled = OrderLabel { tile: Some([16, 8]), ..OrderLabel::new("tiled") };
        let binned = OrderLabel { bins: Some(10), ..tiled.clone() };
        let labels =
            [(OrderLabel::new("scanline"), "scanline"), (tiled, "tiled 16x8"), (binned, "tiled 16x8, bins 10")];
        for (label, text) in labels {
            assert_eq!(label.to_string(), text);
            assert_eq!(text.parse(), Ok(label));
        }
        let pixels = |text: &str| text.parse::<OrderLabel>().map(|label| label.tile_pixels());
        assert_eq!(pixels("tiled 4294967295x4294967295"), Ok(Some(0xffff_fffe_0000_0001)));
        assert_eq!(pixels("scanline"), Ok(None));
        for odd in ["", " 4x4", "tiled 4", "tiled 4x", "tiled 4x4 more", "tiled 4x4, bins", "tiled 4294967296x1"] {
            assert!(pixels(odd).is_err(), "{odd}");
        }
    }

    #[test]
    fn deferred_orders_are_read_as_they_are_written() {
        for order in ["hilbert", "hashed 37x128", "cells of 2048"] {
            for (per_batch, compact) in [(false, false), (true, false), (false, true), (true, true)] {
                let label = DeferredLabel { order: order.to_owned(), per_batch, compact };
                assert_eq!(label.to_string().parse(), Ok(label));
            }
        }
        let label = DeferredLabel { order: "hilbert".into(), per_batch: true, compact: true };
        assert_eq!(label.to_string(), "hilbert per batch compact");
        assert!("".parse::<DeferredLabel>().is_err() && " per batch".parse::<DeferredLabel>().is_err());
    }
}
