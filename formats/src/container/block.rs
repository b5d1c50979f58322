//! A block: a run of records of one batch, compressed and checksummed.

use crate::error::{Error, Result};
use xxhash_rust::xxh3::xxh3_64;

/// Bytes of a block's header.
pub(super) const HEADER_BYTES: usize = 40;
/// First bytes of every block.
pub(super) const TAG: [u8; 4] = *b"PMBL";
/// Largest block, in bytes before and after compression; a reader believes no length beyond it.
pub const MAX_BLOCK: usize = 1 << 26;

/// What a block's payload is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Section {
    /// Records of the stream's kind.
    Records = 0,
    /// Beside the queries: where irradiance is cached.
    IrradianceRecords = 1,
    /// Beside the queries: which cached irradiance each pixel takes.
    PixelWeights = 2,
    /// The end of the stream.
    End = 255,
}

impl Section {
    const fn from_number(number: u8) -> Option<Self> {
        match number {
            0 => Some(Self::Records),
            1 => Some(Self::IrradianceRecords),
            2 => Some(Self::PixelWeights),
            255 => Some(Self::End),
            _ => None,
        }
    }
}

/// Flag bit: the records are simulated but not counted.
const FLAG_WARM_UP: u8 = 1;

/// What a block says of its records.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BlockMeta {
    /// The batch (tile, scanline, sample window) that all its records belong to.
    pub batch: u64,
    /// Simulated, but not counted.
    pub warm_up: bool,
    /// Number of records.
    pub records: u32,
}

/// A block as it stands in a stream.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// What its payload is.
    pub section: Section,
    /// What it says of its records.
    pub meta: BlockMeta,
    compressed: bool,
    raw_len: u32,
    bytes: Vec<u8>,
}

impl Block {
    /// Compresses a payload of records; keeps it as it is where zstd does not make it smaller.
    ///
    /// # Errors
    /// If the payload is larger than [`MAX_BLOCK`].
    pub fn encode(meta: BlockMeta, payload: &[u8], level: i32) -> Result<Self> {
        Self::encode_section(Section::Records, meta, payload, level)
    }

    pub(crate) fn encode_section(section: Section, meta: BlockMeta, payload: &[u8], level: i32) -> Result<Self> {
        if payload.len() > MAX_BLOCK {
            return Err(Error::Invalid(format!("a block of {} bytes; the most is {MAX_BLOCK}", payload.len())));
        }
        let raw_len = u32::try_from(payload.len()).expect("MAX_BLOCK fits in 32 bits");
        let packed = zstd::bulk::compress(payload, level)?;
        let compressed = packed.len() < payload.len();
        let bytes = if compressed { packed } else { payload.to_vec() };
        Ok(Self { section, meta, compressed, raw_len, bytes })
    }

    /// The payload, into a buffer of exactly its size; `None` if it does not fit.
    pub(crate) fn decode_into(&self, payload: &mut [u8]) -> Option<()> {
        if payload.len() != self.raw_len as usize {
            return None;
        }
        if self.compressed {
            let len = zstd::bulk::decompress_to_buffer(&self.bytes, payload).ok()?;
            (len == payload.len()).then_some(())
        } else {
            (self.bytes.len() == payload.len()).then(|| payload.copy_from_slice(&self.bytes))
        }
    }

    /// The payload.
    pub(crate) fn decode(&self) -> Option<Vec<u8>> {
        let mut payload = vec![0; self.raw_len as usize];
        self.decode_into(&mut payload)?;
        Some(payload)
    }

    /// Bytes of the payload before compression.
    #[must_use]
    pub const fn raw_len(&self) -> usize {
        self.raw_len as usize
    }

    /// Bytes of the block in the stream.
    #[must_use]
    pub const fn stored_len(&self) -> usize {
        HEADER_BYTES + self.bytes.len()
    }

    pub(super) fn header(&self) -> [u8; HEADER_BYTES] {
        let mut h = [0; HEADER_BYTES];
        h[0..4].copy_from_slice(&TAG);
        h[4] = self.section as u8;
        h[5] = if self.meta.warm_up { FLAG_WARM_UP } else { 0 };
        h[6] = u8::from(self.compressed);
        h[8..16].copy_from_slice(&self.meta.batch.to_le_bytes());
        h[16..20].copy_from_slice(&self.meta.records.to_le_bytes());
        h[20..24].copy_from_slice(&self.raw_len.to_le_bytes());
        h[24..28].copy_from_slice(&u32::try_from(self.bytes.len()).expect("checked by encode").to_le_bytes());
        let header_sum = short_sum(&h[..28]);
        h[28..32].copy_from_slice(&header_sum);
        h[32..40].copy_from_slice(&xxh3_64(&self.bytes).to_le_bytes());
        h
    }

    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

/// A block's header that fits its own checksum: its lengths may be believed.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockHeader {
    section: Section,
    meta: BlockMeta,
    compressed: bool,
    raw_len: u32,
    pub(super) stored_len: usize,
    checksum: u64,
}

impl BlockHeader {
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
        let known = h[5] & !FLAG_WARM_UP == 0 && h[6] <= 1 && h[7] == 0;
        if !known || raw_len as usize > MAX_BLOCK || stored_len > MAX_BLOCK {
            return Err("a block's header makes no sense");
        }
        let meta = BlockMeta { batch: long(8), warm_up: h[5] & FLAG_WARM_UP != 0, records: word(16) };
        Ok(Self { section, meta, compressed: h[6] == 1, raw_len, stored_len, checksum: long(32) })
    }

    pub(super) fn with_bytes(self, bytes: Vec<u8>) -> std::result::Result<Block, &'static str> {
        if xxh3_64(&bytes) != self.checksum {
            return Err("a block does not fit its checksum");
        }
        let Self { section, meta, compressed, raw_len, .. } = self;
        Ok(Block { section, meta, compressed, raw_len, bytes })
    }
}

/// The low half of XXH3-64.
fn short_sum(bytes: &[u8]) -> [u8; 4] {
    xxh3_64(bytes).to_le_bytes()[..4].try_into().expect("four of eight bytes")
}
