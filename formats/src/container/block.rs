//! A block: a run of records of one batch, compressed and checksummed.

use super::block_header::{BlockHeader, HEADER_BYTES, MAX_BLOCK, Packing};
use super::packing::{compress, compress_long, decompress, prepare};
use super::section::{BlockMeta, Section};
use crate::error::{Error, Result};
use std::borrow::Cow;
use xxhash_rust::xxh3::xxh3_64;

/// What is done to the payloads of a stream's blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// Compressed where that makes them smaller: for files.
    #[default]
    Zstd,
    /// Nothing: for a pipe, whose reader would undo it at once.
    None,
}

/// A block as it stands in a stream.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// What its payload is.
    pub section: Section,
    /// What it says of its records.
    pub meta: BlockMeta,
    packing: Packing,
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

    /// The same, compressed or not.
    ///
    /// # Errors
    /// As [`encode`](Self::encode).
    pub(crate) fn encode_as(meta: BlockMeta, payload: Vec<u8>, level: i32, compression: Compression) -> Result<Self> {
        match compression {
            Compression::Zstd => Self::encode(meta, &payload, level),
            Compression::None => Self::packed(Section::Records, meta, payload.into(), |_| Ok(None)),
        }
    }

    /// The same where what repeats may be far apart, anywhere in the payload.
    ///
    /// # Errors
    /// As [`encode`](Self::encode).
    pub(crate) fn encode_long(meta: BlockMeta, payload: &[u8], level: i32) -> Result<Self> {
        Self::packed(Section::Records, meta, payload.into(), |payload| compress_long(payload, level).map(Some))
    }

    /// A block of a trace whose payload of so many bytes was packed by those who know its walks.
    ///
    /// # Panics
    /// If the payload is larger than [`MAX_BLOCK`].
    pub(crate) fn of_walks(meta: BlockMeta, raw_len: usize, bytes: Vec<u8>) -> Self {
        assert!(raw_len <= MAX_BLOCK, "a block of {raw_len} bytes");
        let raw_len = u32::try_from(raw_len).expect("MAX_BLOCK fits in 32 bits");
        Self { section: Section::Records, meta, packing: Packing::Walks, raw_len, bytes }
    }

    /// What is stored of a payload that was packed so.
    pub(crate) fn walks(&self) -> Option<&[u8]> {
        (self.packing == Packing::Walks).then_some(&self.bytes)
    }

    pub(crate) fn encode_section(section: Section, meta: BlockMeta, payload: &[u8], level: i32) -> Result<Self> {
        Self::packed(section, meta, payload.into(), |payload| compress(payload, level).map(Some))
    }

    fn packed(
        section: Section,
        meta: BlockMeta,
        payload: Cow<'_, [u8]>,
        pack: impl FnOnce(&[u8]) -> std::io::Result<Option<Vec<u8>>>,
    ) -> Result<Self> {
        if payload.len() > MAX_BLOCK {
            return Err(Error::Invalid(format!("a block of {} bytes; the most is {MAX_BLOCK}", payload.len())));
        }
        let raw_len = u32::try_from(payload.len()).expect("MAX_BLOCK fits in 32 bits");
        let (packing, bytes) = match pack(&payload)?.filter(|packed| packed.len() < payload.len()) {
            Some(packed) => (Packing::Zstd, packed),
            None => (Packing::Plain, payload.into_owned()),
        };
        Ok(Self { section, meta, packing, raw_len, bytes })
    }

    /// Sees whether there is memory to decompress it.
    ///
    /// # Errors
    /// [`Error::Io`] if there is none.
    pub(super) fn check_memory(&self) -> Result<()> {
        if self.packing == Packing::Plain { Ok(()) } else { Ok(prepare()?) }
    }

    /// The payload, if it is stored as it is.
    pub(crate) fn plain(&self) -> Option<&[u8]> {
        (self.packing == Packing::Plain && self.bytes.len() == self.raw_len()).then_some(&self.bytes)
    }

    /// The payload, into a buffer of exactly its size; `None` if it does not fit, or has walks that are packed.
    pub(crate) fn decode_into(&self, payload: &mut [u8]) -> Option<()> {
        if payload.len() != self.raw_len as usize {
            return None;
        }
        match self.packing {
            Packing::Plain => self.plain().map(|bytes| payload.copy_from_slice(bytes)),
            Packing::Zstd => (decompress(&self.bytes, payload).ok()? == payload.len()).then_some(()),
            Packing::Walks => None,
        }
    }

    /// The payload; `None` as from [`decode_into`](Self::decode_into).
    pub(crate) fn decode(&self) -> Option<Vec<u8>> {
        if self.packing == Packing::Walks {
            return None;
        }
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
        let Self { section, meta, packing, raw_len, .. } = *self;
        let (stored_len, checksum) = (self.bytes.len(), xxh3_64(&self.bytes));
        BlockHeader { section, meta, packing, raw_len, stored_len, checksum }.to_bytes()
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
        let BlockHeader { section, meta, packing, raw_len, .. } = *header;
        Ok(Self { section, meta, packing, raw_len, bytes })
    }
}
