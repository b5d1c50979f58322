//! Tables of 32-bit words, a row each, as blocks.

use crate::container::{Block, BlockMeta, Section};
use crate::digest::{Digest, Tally};
use crate::error::{Error, Result};
use xxhash_rust::xxh3::xxh3_128_with_seed;

/// zstd level: the tables are mostly floats.
const LEVEL: i32 = 1;
/// What a block beside the records adds to the stream's digest; `None` if it does not hold what it says.
#[must_use]
pub fn tally_beside(block: &Block) -> Option<Tally> {
    let (words, width) = decode(block)?;
    Some(tally(block.section, &words, width))
}

/// Words by columns, since like compresses best beside like.
pub(super) fn encode(section: Section, words: &[u32], rows: usize) -> Result<(Block, Tally)> {
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

/// The words of a block by rows, and how many a row has; `None` if it does not hold what it says.
pub(super) fn decode(block: &Block) -> Option<(Vec<u32>, usize)> {
    let rows = block.meta.records as usize;
    let count = block.raw_len() / 4;
    let width = count / rows.max(1);
    // A row has a word at least: as many as a header claims and no byte of them are no table.
    if rows > count || width * rows * 4 != block.raw_len() {
        return None;
    }
    let mut columns = vec![0u32; count];
    block.decode_into(bytemuck::cast_slice_mut(&mut columns))?;
    let words = (0..rows).flat_map(|row| columns.iter().skip(row).step_by(rows)).copied().collect();
    Some((words, width))
}

/// The section is part of the hash: a row of one table is none of the other.
pub(super) fn tally(section: Section, words: &[u32], width: usize) -> Tally {
    let mut tally = Tally::default();
    for row in words.chunks_exact(width.max(1)) {
        tally.digest += Digest(xxh3_128_with_seed(bytemuck::cast_slice(row), section as u64));
    }
    tally
}
