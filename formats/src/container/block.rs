//! A block: a run of records of one batch, compressed and checksummed.

use super::block_header::{BlockHeader, HEADER_BYTES, MAX_BLOCK};
use super::packing::{compress, decompress, prepare};
use super::section::{BlockMeta, Section};
use crate::error::{Error, Result};
use xxhash_rust::xxh3::xxh3_64;
use zstd::zstd_safe::CParameter;

/// zstd level of blocks that are kept.
const ARCHIVE_LEVEL: i32 = 19;

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

    /// The same where what repeats may be far apart, anywhere in the payload.
    ///
    /// # Errors
    /// As [`encode`](Self::encode).
    pub(crate) fn encode_long(meta: BlockMeta, payload: &[u8], level: i32) -> Result<Self> {
        // All of the payload in the window, but for the smallest and the largest that zstd has.
        let window = payload.len().next_power_of_two().ilog2().clamp(10, 27);
        let mut compressor = zstd::bulk::Compressor::new(level)?;
        compressor.set_parameter(CParameter::EnableLongDistanceMatching(true))?;
        compressor.set_parameter(CParameter::WindowLog(window))?;
        Self::packed(Section::Records, meta, payload, |payload| compressor.compress(payload))
    }

    /// The same block for keeping: as many searches in fewer bytes, read as fast and written much slower.
    ///
    /// # Errors
    /// [`Error::Invalid`] if its payload is none.
    pub(crate) fn archived(self) -> Result<Self> {
        let payload = self.decode().ok_or_else(|| Error::Invalid("a block's payload cannot be decompressed".into()))?;
        let kept = Self::encode_long(self.meta, &payload, ARCHIVE_LEVEL)?;
        Ok(if kept.bytes.len() < self.bytes.len() { kept } else { self })
    }

    pub(crate) fn encode_section(section: Section, meta: BlockMeta, payload: &[u8], level: i32) -> Result<Self> {
        Self::packed(section, meta, payload, |payload| compress(payload, level))
    }

    fn packed(
        section: Section,
        meta: BlockMeta,
        payload: &[u8],
        pack: impl FnOnce(&[u8]) -> std::io::Result<Vec<u8>>,
    ) -> Result<Self> {
        if payload.len() > MAX_BLOCK {
            return Err(Error::Invalid(format!("a block of {} bytes; the most is {MAX_BLOCK}", payload.len())));
        }
        let raw_len = u32::try_from(payload.len()).expect("MAX_BLOCK fits in 32 bits");
        let packed = pack(payload)?;
        let compressed = packed.len() < payload.len();
        let bytes = if compressed { packed } else { payload.to_vec() };
        Ok(Self { section, meta, compressed, raw_len, bytes })
    }

    /// Sees whether there is memory to decompress it.
    ///
    /// # Errors
    /// [`Error::Io`] if there is none.
    pub(super) fn check_memory(&self) -> Result<()> {
        if self.compressed { Ok(prepare()?) } else { Ok(()) }
    }

    /// The payload, into a buffer of exactly its size; `None` if it does not fit.
    pub(crate) fn decode_into(&self, payload: &mut [u8]) -> Option<()> {
        if payload.len() != self.raw_len as usize {
            return None;
        }
        if self.compressed {
            let len = decompress(&self.bytes, payload).ok()?;
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

    /// The header that stands before [`bytes`](Self::bytes).
    pub(super) fn header(&self) -> [u8; HEADER_BYTES] {
        let Self { section, meta, compressed, raw_len, .. } = *self;
        let (stored_len, checksum) = (self.bytes.len(), xxh3_64(&self.bytes));
        BlockHeader { section, meta, compressed, raw_len, stored_len, checksum }.to_bytes()
    }

    /// What is stored of the payload.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The block of a header and the bytes behind it.
    ///
    /// # Errors
    /// What is wrong, if they do not fit.
    pub(super) fn of_header(header: &BlockHeader, bytes: Vec<u8>) -> std::result::Result<Self, &'static str> {
        if xxh3_64(&bytes) != header.checksum {
            return Err("a block does not fit its checksum");
        }
        let BlockHeader { section, meta, compressed, raw_len, .. } = *header;
        Ok(Self { section, meta, compressed, raw_len, bytes })
    }
}
