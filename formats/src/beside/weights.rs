//! What pixels take of cached irradiance.

use super::table::{decode, encode, tally};
use crate::container::{Block, Section};
use crate::digest::Tally;
use crate::error::Result;
use bytemuck::{Pod, Zeroable};

/// What a pixel takes of a record's irradiance.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PixelWeight {
    /// The pixel.
    pub pixel: u32,
    /// The record.
    pub record: u32,
    /// What the irradiance, moved and turned, is multiplied by, linear RGB.
    pub weight: [f32; 3],
    /// From the record to the point seen, in scene units.
    pub displacement: [f32; 3],
    /// Cross product of the record's normal and that of the point seen.
    pub normal_change: [f32; 3],
}

/// Packs pixel weights into a block.
///
/// # Errors
/// [`Error::Invalid`](crate::Error::Invalid) if they are too many for one.
pub fn encode_weights(weights: &[PixelWeight]) -> Result<(Block, Tally)> {
    encode(Section::PixelWeights, bytemuck::cast_slice(weights), weights.len())
}

/// The pixel weights of a block, and what they add to the stream's digest; `None` if it does not hold what it says.
#[must_use]
pub fn decode_weights(block: &Block) -> Option<(Vec<PixelWeight>, Tally)> {
    let (words, width) = decode(block)?;
    let fits = width == size_of::<PixelWeight>() / 4 || words.is_empty();
    fits.then(|| (bytemuck::cast_slice::<_, PixelWeight>(&words).to_vec(), tally(block.section, &words, width)))
}
