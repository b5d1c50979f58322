//! The generative orders that there are: a line for each.

use super::direction_binned::DirectionBinned;
use super::order::GenerativeOrder;
use super::scanline::Scanline;
use super::tiled::Tiled;
use pm_registry::Registry;

/// All generative orders, the usual one first.
#[must_use]
pub fn generative_orders() -> Registry<dyn GenerativeOrder> {
    Registry::new("generative order", &[&Scanline, &Tiled, &DirectionBinned])
}
