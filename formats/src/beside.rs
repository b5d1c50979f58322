//! What stands beside the queries of a stream: cached irradiance, and which pixel takes how much of it.
//!
//! Tables of 32-bit words, a row each; covered by the stream's digest, not counted among its records, and passed on by
//! every program as they are.

mod irradiance;
mod table;
mod weights;

pub use irradiance::{IrradianceRay, IrradianceRecord, decode_irradiance, encode_irradiance};
pub use table::tally_beside;
pub use weights::{PixelWeight, decode_weights, encode_weights};

#[cfg(test)]
mod tests;
