//! What stands beside the queries of a stream: cached irradiance, and which pixel takes how much of it.
//!
//! Tables of 32-bit words, a row each; covered by the stream's digest, not counted among its records, and passed on by
//! every program as they are.

use crate::container::{Block, BlockMeta, Section};
use crate::digest::{Digest, Tally};
use crate::error::{Error, Result};
use bytemuck::{Pod, Zeroable};
use xxhash_rust::xxh3::xxh3_128_with_seed;

/// zstd level: the tables are mostly floats.
const LEVEL: i32 = 1;
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
        let count = u64::from(strata[0]) * u64::from(strata[1]);
        let fits = count > 0 && rays.len() as u64 == count * RAY as u64;
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

/// Packs pixel weights into a block.
///
/// # Errors
/// [`Error::Invalid`] if they are too many for one.
pub fn encode_weights(weights: &[PixelWeight]) -> Result<(Block, Tally)> {
    encode(Section::PixelWeights, bytemuck::cast_slice(weights), weights.len())
}

/// The irradiance records of a block, and what they add to the stream's digest; `None` if it does not hold what it says.
#[must_use]
pub fn decode_irradiance(block: &Block) -> Option<(Vec<IrradianceRecord>, Tally)> {
    let (words, width) = decode(block)?;
    let records: Option<_> = words.chunks_exact(width.max(1)).map(IrradianceRecord::from_words).collect();
    Some((records?, tally(block.section, &words, width)))
}

/// The pixel weights of a block, and what they add to the stream's digest; `None` if it does not hold what it says.
#[must_use]
pub fn decode_weights(block: &Block) -> Option<(Vec<PixelWeight>, Tally)> {
    let (words, width) = decode(block)?;
    let fits = width == size_of::<PixelWeight>() / 4 || words.is_empty();
    fits.then(|| (bytemuck::cast_slice::<_, PixelWeight>(&words).to_vec(), tally(block.section, &words, width)))
}

/// What a block beside the records adds to the stream's digest; `None` if it does not hold what it says.
#[must_use]
pub fn tally_beside(block: &Block) -> Option<Tally> {
    let (words, width) = decode(block)?;
    Some(tally(block.section, &words, width))
}

/// Words by columns, since like compresses best beside like.
fn encode(section: Section, words: &[u32], rows: usize) -> Result<(Block, Tally)> {
    let width = words.len() / rows.max(1);
    let mut columns: Vec<u32> = Vec::with_capacity(words.len());
    for column in 0..width {
        columns.extend(words.iter().skip(column).step_by(width));
    }
    let records = u32::try_from(rows).map_err(|_| Error::Invalid("too many rows for a block".into()))?;
    let meta = BlockMeta { records, ..BlockMeta::default() };
    let block = Block::encode_section(section, meta, bytemuck::cast_slice(&columns), LEVEL)?;
    Ok((block, tally(section, words, width)))
}

fn decode(block: &Block) -> Option<(Vec<u32>, usize)> {
    let rows = block.meta.records as usize;
    let count = block.raw_len() / 4;
    let width = count / rows.max(1);
    if width * rows * 4 != block.raw_len() {
        return None;
    }
    let mut columns = vec![0u32; count];
    block.decode_into(bytemuck::cast_slice_mut(&mut columns))?;
    let words = (0..rows).flat_map(|row| columns.iter().skip(row).step_by(rows)).copied().collect();
    Some((words, width))
}

/// The section is part of the hash: a row of one table is none of the other.
fn tally(section: Section, words: &[u32], width: usize) -> Tally {
    let mut tally = Tally::default();
    for row in words.chunks_exact(width.max(1)) {
        tally.digest += Digest(xxh3_128_with_seed(bytemuck::cast_slice(row), section as u64));
    }
    tally
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(pixel: u32) -> IrradianceRecord {
        let ray = |i: u16| IrradianceRay { length: f32::from(i) * 0.1, light: [0.0, f32::from(i), 1.0] };
        IrradianceRecord {
            pixel,
            position: [1.0, 2.0, 3.0],
            normal: [0.0, 1.0, 0.0],
            radius: 0.25,
            strata: [2, 3],
            rays: (0..6).map(ray).collect(),
        }
    }

    #[test]
    fn tables_come_back_and_are_told_apart() {
        let records: Vec<_> = (0..5).map(record).collect();
        let (block, tally) = encode_irradiance(&records).unwrap();
        assert_eq!(decode_irradiance(&block), Some((records.clone(), tally)));
        assert_eq!(tally_beside(&block), Some(tally));
        assert_eq!(tally.records, 0);
        let weight = PixelWeight {
            pixel: 7,
            record: 2,
            weight: [0.5; 3],
            displacement: [0.0, 0.1, 0.2],
            normal_change: [0.0; 3],
        };
        let (block, weights_tally) = encode_weights(&[weight, weight]).unwrap();
        assert_eq!(decode_weights(&block), Some((vec![weight, weight], weights_tally)));
        assert_eq!(tally_beside(&block), Some(weights_tally));
        assert_ne!(tally.digest, weights_tally.digest);
        assert_eq!(decode_irradiance(&block), None);
        assert_eq!(decode_weights(&encode_irradiance(&records).unwrap().0), None);
    }

    #[test]
    fn records_of_different_strata_are_refused() {
        let mut odd = record(1);
        odd.strata = [1, 3];
        odd.rays.truncate(3);
        assert!(encode_irradiance(&[record(0), record(2), odd]).is_err());
    }
}
