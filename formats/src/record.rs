//! Records of fixed size, and how a block holds them.

mod columns;
mod direction;
mod photon;
mod query;
mod rgbe;
mod unrounded_photon;

pub use direction::{pack_direction, unpack_direction};
pub use photon::Photon;
pub use query::Query;
pub use rgbe::{pack_rgbe, unpack_rgbe};
pub use unrounded_photon::UnroundedPhoton;

use crate::container::{Block, BlockMeta, Compression, Header, Section, StreamKind};
use crate::digest::Tally;
use crate::error::Result;
use bytemuck::Pod;
use columns::{columns, put_back, tally};
use std::borrow::Cow;

#[cfg(target_endian = "big")]
compile_error!("records are little-endian and are read in place: this library needs a little-endian machine");

/// Most records in a block.
pub const BLOCK_RECORDS: usize = 4096;
/// zstd level for records: positions hardly compress, so more effort buys nothing.
const LEVEL: i32 = 1;

/// A record of fixed size, a whole number of 32-bit words.
pub trait Record: Pod {
    /// The kind of stream it makes.
    const KIND: StreamKind;

    /// What is wrong with the record in a stream with this header, if anything is.
    fn problem(&self, header: &Header) -> Option<&'static str>;
}

/// Packs records of one batch into a block, word by word: first the first words of all records, then the second words,
/// and so on, since like compresses best beside like.
///
/// # Errors
/// If the records are too many for a block.
pub fn encode_records<T: Record>(meta: BlockMeta, records: &[T]) -> Result<(Block, Tally)> {
    encode_records_as(meta, records, Compression::Zstd)
}

/// The same, compressed or not.
///
/// # Errors
/// As [`encode_records`].
pub(crate) fn encode_records_as<T: Record>(
    meta: BlockMeta,
    records: &[T],
    compression: Compression,
) -> Result<(Block, Tally)> {
    let count = u32::try_from(records.len()).expect("a block's worth of records");
    let columns = columns(words(records), words_each::<T>());
    let meta = BlockMeta { records: count, ..meta };
    let block = Block::encode_as(meta, columns, LEVEL, compression)?;
    Ok((block, tally(words(records), words_each::<T>())))
}

/// The records of a block; `None` if the payload does not hold what the block says.
#[must_use]
pub fn decode_records<T: Record>(block: &Block) -> Option<(Vec<T>, Tally)> {
    let count = block.meta.records as usize;
    if block.section != Section::Records || block.raw_len() != count * size_of::<T>() {
        return None;
    }
    // What is stored as it is, is read where it lies, unless it lies askew.
    let columns = match block.plain().and_then(|bytes| bytemuck::try_cast_slice(bytes).ok()) {
        Some(columns) => Cow::Borrowed(columns),
        None => {
            let mut columns = vec![0u32; count * words_each::<T>()];
            block.decode_into(bytemuck::cast_slice_mut(&mut columns))?;
            Cow::Owned(columns)
        }
    };
    let mut records = vec![T::zeroed(); count];
    put_back(&columns, bytemuck::cast_slice_mut(&mut records), words_each::<T>());
    let tally = tally(words(&records), words_each::<T>());
    Some((records, tally))
}

/// The records of a block of a stream with this header, each of them fit for use.
///
/// # Errors
/// What is wrong, for [`BlockReader::damaged`](crate::BlockReader::damaged).
pub fn decode_checked<T: Record>(block: &Block, header: &Header) -> std::result::Result<(Vec<T>, Tally), &'static str> {
    let (records, tally) = decode_records::<T>(block).ok_or("a block does not hold its records")?;
    match records.iter().find_map(|record| record.problem(header)) {
        Some(what) => Err(what),
        None => Ok((records, tally)),
    }
}

/// Words of a record.
const fn words_each<T: Record>() -> usize {
    size_of::<T>() / 4
}

fn words<T: Record>(records: &[T]) -> &[u32] {
    bytemuck::cast_slice(records)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_the_papers() {
        assert_eq!(size_of::<Photon>(), 20);
        assert_eq!(size_of::<Query>(), 44);
        assert_eq!(size_of::<UnroundedPhoton>(), 32);
    }

    #[test]
    fn a_block_gives_its_records_back() {
        let records: Vec<Photon> = (0..100u8)
            .map(|i| {
                Photon::new([f32::from(i), 0.5, -1.0], [1.0, 2.0, 3.0], [0.5; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])
            })
            .map(Option::unwrap)
            .collect();
        for n in [0, 1, 100] {
            let meta = BlockMeta { batch: 7, warm_up: true, records: 0 };
            let (block, tally) = encode_records(meta, &records[..n]).unwrap();
            assert_eq!(decode_records::<Photon>(&block), Some((records[..n].to_vec(), tally)));
            assert_eq!(block.meta, BlockMeta { records: n as u32, ..meta });
            // The wrong kind of record does not fit.
            assert!(n == 0 || decode_records::<Query>(&block).is_none());
        }
    }

    #[test]
    fn the_split_axis_leaves_the_normal_alone() {
        let photon = Photon::new([0.0; 3], [1.0; 3], [0.5; 3], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]).unwrap();
        for axis in [2, 0, 1] {
            let node = photon.with_axis(axis);
            assert_eq!(node.axis(), axis);
            assert_eq!(node.normal(), [0.0, -1.0, 0.0]);
        }
    }
}
