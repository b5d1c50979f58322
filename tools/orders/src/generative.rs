//! Generative orders: in which order a picture's pixels are visited.
//!
//! Steinhurst, Coombe, Lastra, GI 2005, section 3.1.

mod direction_binned;
mod order;
mod pass;
mod promises;
mod registry;
mod scanline;
mod tiled;

pub use order::{Generative, GenerativeOrder, PixelRun, Span};
pub use pass::{Pass, VisiblePoints};
pub(crate) use promises::broken_promise;
pub use registry::generative_orders;

#[cfg(test)]
mod tests;
