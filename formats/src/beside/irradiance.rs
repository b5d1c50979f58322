//! Places where irradiance is cached.

use super::table::{decode, encode, tally};
use crate::container::{Block, Section};
use crate::digest::Tally;
use crate::error::{Error, Result};
use bytemuck::{Pod, Zeroable};

/// Words of an irradiance record before its rays.
const HEAD: usize = 10;
/// Words of each of its rays.
const RAY: usize = 4;

/// A place where irradiance is cached (Ward, Rubinstein, Clear: *A Ray Tracing Solution for Diffuse Interreflection*,
/// SIGGRAPH 1988). Its id is its place among the records of the stream, from 0; queries that belong to it carry the id.
#[derive(Clone, Debug, PartialEq)]
pub struct IrradianceRecord {
    /// Pixel that asked for it first.
    pub pixel: u32,
    /// Where, in scene units.
    pub position: [f32; 3],
    /// Unit surface normal on the viewer's side.
    pub normal: [f32; 3],
    /// How far it is from what it sees, in scene units: the scale at which irradiance changes.
    pub radius: f32,
    /// Strata of elevation and of azimuth; ray (row, column) is sample `row * columns + column`.
    pub strata: [u32; 2],
    /// The rays, `strata[0] * strata[1]` of them.
    pub rays: Vec<IrradianceRay>,
}

/// A ray of an irradiance record.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct IrradianceRay {
    /// Its length to the first surface, in scene units; infinite if it missed, and then its radiance is 0.
    pub length: f32,
    /// Radiance of lights it met in mirrors or through glass, which no query asks for; linear RGB.
    pub light: [f32; 3],
}

impl IrradianceRecord {
    fn words(&self) -> Vec<u32> {
        let mut words = vec![self.pixel];
        words.extend(self.position.iter().chain(&self.normal).chain([&self.radius]).map(|x| x.to_bits()));
        words.extend(self.strata);
        words.extend(bytemuck::cast_slice::<_, u32>(&self.rays));
        words
    }

    fn from_words(words: &[u32]) -> Option<Self> {
        let (head, rays) = words.split_at_checked(HEAD)?;
        let float = |at: usize| f32::from_bits(head[at]);
        let strata = [head[8], head[9]];
        // Of strata without number the product is none.
        let count = strata[0].checked_mul(strata[1])? as usize;
        let fits = count > 0 && Some(rays.len()) == count.checked_mul(RAY);
        fits.then(|| Self {
            pixel: head[0],
            position: [float(1), float(2), float(3)],
            normal: [float(4), float(5), float(6)],
            radius: float(7),
            strata,
            rays: rays.chunks_exact(RAY).map(|ray| *bytemuck::from_bytes(bytemuck::cast_slice(ray))).collect(),
        })
    }
}

/// Packs irradiance records, all of the same strata, into a block.
///
/// # Errors
/// [`Error::Invalid`] if they are too many for one, or of different strata.
pub fn encode_irradiance(records: &[IrradianceRecord]) -> Result<(Block, Tally)> {
    if records.windows(2).any(|pair| pair[0].strata != pair[1].strata) {
        return Err(Error::Invalid("irradiance records of different strata in one block".into()));
    }
    let words: Vec<u32> = records.iter().flat_map(IrradianceRecord::words).collect();
    encode(Section::IrradianceRecords, &words, records.len())
}

/// The irradiance records of a block, and what they add to the stream's digest; `None` if it does not hold what it says.
#[must_use]
pub fn decode_irradiance(block: &Block) -> Option<(Vec<IrradianceRecord>, Tally)> {
    let (words, width) = decode(block)?;
    let records: Option<_> = words.chunks_exact(width.max(1)).map(IrradianceRecord::from_words).collect();
    Some((records?, tally(block.section, &words, width)))
}
