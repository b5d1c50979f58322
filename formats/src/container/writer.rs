//! Streams, written block by block.

use super::block::Block;
use super::end::SealedEnd;
use super::order::OrderProof;
use super::section::{BlockMeta, Section};
use super::spelling::encode;
use super::{End, FORMAT_VERSION, Header, MAGIC, StreamKind};
use crate::error::{Error, Result};
use std::io::Write;
use xxhash_rust::xxh3::xxh3_64;

/// Writes a stream block by block, whatever its records are.
///
/// Only [`finish`](Self::finish) writes the end block: a writer that is dropped leaves a stream that every reader sees
/// to be unfinished.
pub struct BlockWriter<W> {
    output: W,
    order: OrderProof,
}

impl<W: Write> BlockWriter<W> {
    /// Writes the header.
    ///
    /// # Errors
    /// [`Error::Io`], or [`Error::Invalid`] for a header beyond the limit.
    pub fn new(mut output: W, kind: StreamKind, header: &Header) -> Result<Self> {
        let record = encode(header)?;
        let mut bytes = Vec::with_capacity(16 + record.len());
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&FORMAT_VERSION.to_le_bytes());
        bytes.extend_from_slice(&(kind as u16).to_le_bytes());
        let len = u32::try_from(record.len()).map_err(|_| Error::Invalid("the header is too large".into()))?;
        bytes.extend_from_slice(&len.to_le_bytes());
        bytes.extend_from_slice(&record);
        let prelude = [&bytes[..16], &xxh3_64(&bytes).to_le_bytes()].concat();
        output.write_all(&prelude)?;
        output.write_all(&record)?;
        // Whoever reads the pipe can begin (or complain) at once.
        output.flush()?;
        Ok(Self { output, order: OrderProof::new(&prelude) })
    }

    /// Writes a block of records.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn write(&mut self, block: &Block) -> Result<()> {
        let header = block.header();
        self.order.add(&header);
        self.output.write_all(&header)?;
        self.output.write_all(block.bytes())?;
        Ok(())
    }

    /// Writes the end block: the only way to a whole stream.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn finish(mut self, end: &End) -> Result<W> {
        let sealed = SealedEnd { end: end.clone(), order: self.order.sum() };
        self.write(&Block::encode_section(Section::End, BlockMeta::default(), &encode(&sealed)?, 0)?)?;
        self.output.flush()?;
        Ok(self.output)
    }
}
