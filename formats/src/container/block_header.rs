//! A block's header: lengths and checksums, byte by byte.

use super::section::{BlockMeta, Section};
use xxhash_rust::xxh3::xxh3_64;

/// Bytes of a block's header.
pub(super) const HEADER_BYTES: usize = 40;
/// First bytes of every block.
const TAG: [u8; 4] = *b"PMBL";
/// Largest block, in bytes before and after compression; a reader believes no length beyond it.
pub const MAX_BLOCK: usize = 1 << 26;

/// Flag bit: the records are simulated but not counted.
const FLAG_WARM_UP: u8 = 1;

/// What was done to a block's payload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    /// Nothing.
    Plain = 0,
    /// Compressed by zstd.
    Zstd = 1,
    /// Walks of a trace are coded by those before them, the rest is compressed by zstd.
    Walks = 2,
}

impl Packing {
    const fn of(number: u8) -> Option<Self> {
        match number {
            0 => Some(Self::Plain),
            1 => Some(Self::Zstd),
            2 => Some(Self::Walks),
            _ => None,
        }
    }
}

/// A block's header. One that was parsed fits its own checksum: its lengths may be believed.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockHeader {
    pub(super) section: Section,
    pub(super) meta: BlockMeta,
    /// What is stored of the payload.
    pub(super) packing: Packing,
    /// Bytes of the payload before compression.
    pub(super) raw_len: u32,
    /// Bytes that follow the header.
    pub(super) stored_len: usize,
    /// XXH3-64 of those.
    pub(super) checksum: u64,
}

impl BlockHeader {
    /// As it stands in a stream.
    ///
    /// # Panics
    /// If `stored_len` is beyond 32 bits, which no block's is.
    pub(super) fn to_bytes(self) -> [u8; HEADER_BYTES] {
        let mut h = [0; HEADER_BYTES];
        h[0..4].copy_from_slice(&TAG);
        h[4] = self.section as u8;
        h[5] = if self.meta.warm_up { FLAG_WARM_UP } else { 0 };
        h[6] = self.packing as u8;
        h[8..16].copy_from_slice(&self.meta.batch.to_le_bytes());
        h[16..20].copy_from_slice(&self.meta.records.to_le_bytes());
        h[20..24].copy_from_slice(&self.raw_len.to_le_bytes());
        h[24..28].copy_from_slice(&u32::try_from(self.stored_len).expect("a block's length").to_le_bytes());
        let header_sum = short_sum(&h[..28]);
        h[28..32].copy_from_slice(&header_sum);
        h[32..40].copy_from_slice(&self.checksum.to_le_bytes());
        h
    }

    /// Of bytes that begin with the tag and fit their checksum.
    pub(super) fn parse(h: &[u8; HEADER_BYTES]) -> std::result::Result<Self, &'static str> {
        let word = |at: usize| u32::from_le_bytes(h[at..at + 4].try_into().expect("four bytes"));
        let long = |at: usize| u64::from_le_bytes(h[at..at + 8].try_into().expect("eight bytes"));
        if h[0..4] != TAG {
            return Err("a block does not begin with its tag");
        }
        if h[28..32] != short_sum(&h[..28]) {
            return Err("a block's header does not fit its checksum");
        }
        let section = Section::from_number(h[4]).ok_or("a block of a sort this program does not know")?;
        let (raw_len, stored_len) = (word(20), word(24) as usize);
        let packing = Packing::of(h[6]).filter(|_| h[5] & !FLAG_WARM_UP == 0 && h[7] == 0);
        let packing = packing.ok_or("a block's header makes no sense")?;
        if raw_len as usize > MAX_BLOCK || stored_len > MAX_BLOCK {
            return Err("a block's header makes no sense");
        }
        let meta = BlockMeta { batch: long(8), warm_up: h[5] & FLAG_WARM_UP != 0, records: word(16) };
        Ok(Self { section, meta, packing, raw_len, stored_len, checksum: long(32) })
    }
}

/// The low half of XXH3-64.
fn short_sum(bytes: &[u8]) -> [u8; 4] {
    xxh3_64(bytes).to_le_bytes()[..4].try_into().expect("four of eight bytes")
}
