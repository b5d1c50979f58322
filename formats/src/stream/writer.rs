//! Streams of records, written in blocks.

use crate::container::{Block, BlockMeta, BlockWriter, Compression, End, Header, StageReport};
use crate::digest::Tally;
use crate::error::Result;
use crate::record::{BLOCK_RECORDS, Record, encode_records_as};
use std::io::Write;

/// Writes records of one kind, cutting blocks at [`BLOCK_RECORDS`] and wherever the batch changes.
pub struct RecordWriter<T, W> {
    blocks: BlockWriter<W>,
    meta: BlockMeta,
    held: Vec<T>,
    tally: Tally,
    compression: Compression,
}

impl<T: Record, W: Write> RecordWriter<T, W> {
    /// Writes the header.
    ///
    /// # Errors
    /// As [`BlockWriter::new`].
    pub fn new(output: W, header: &Header) -> Result<Self> {
        let blocks = BlockWriter::new(output, T::KIND, header)?;
        Ok(Self {
            blocks,
            meta: BlockMeta::default(),
            held: Vec::with_capacity(BLOCK_RECORDS),
            tally: Tally::default(),
            compression: Compression::default(),
        })
    }

    /// The same writer, which compresses its blocks, or does not.
    #[must_use]
    pub fn with_compression(self, compression: Compression) -> Self {
        Self { compression, ..self }
    }

    /// Writes records that belong to `meta`'s batch (its record count is ignored).
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn write(&mut self, meta: BlockMeta, records: &[T]) -> Result<()> {
        let meta = BlockMeta { records: 0, ..meta };
        if meta != self.meta {
            self.cut()?;
            self.meta = meta;
        }
        let mut rest = records;
        while !rest.is_empty() {
            // A whole block is not copied first.
            if let Some((block, later)) = rest.split_first_chunk::<BLOCK_RECORDS>().filter(|_| self.held.is_empty()) {
                self.encode(block)?;
                rest = later;
                continue;
            }
            let (now, later) = rest.split_at(rest.len().min(BLOCK_RECORDS - self.held.len()));
            self.held.extend_from_slice(now);
            rest = later;
            if self.held.len() == BLOCK_RECORDS {
                self.cut()?;
            }
        }
        Ok(())
    }

    /// Writes a block that stands beside the records, with what it adds to the digest.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn write_beside(&mut self, block: &Block, tally: Tally) -> Result<()> {
        self.cut()?;
        self.blocks.write(block)?;
        self.tally += tally;
        Ok(())
    }

    fn cut(&mut self) -> Result<()> {
        if self.held.is_empty() {
            return Ok(());
        }
        let held = std::mem::take(&mut self.held);
        self.encode(&held)?;
        self.held = held;
        self.held.clear();
        Ok(())
    }

    /// Writes a block of the batch in hand.
    fn encode(&mut self, records: &[T]) -> Result<()> {
        let (block, tally) = encode_records_as(self.meta, records, self.compression)?;
        self.blocks.write(&block)?;
        self.tally += tally;
        Ok(())
    }

    /// Number and digest of the records written, those still held left out.
    #[must_use]
    pub const fn tally(&self) -> Tally {
        self.tally
    }

    /// Writes the rest and the end block with what each stage measured.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn finish(mut self, stages: Vec<StageReport>) -> Result<W> {
        self.cut()?;
        self.blocks.finish(&End { tally: self.tally, stages })
    }

    /// As [`finish`](Self::finish), for a stage that must end with the records it was given: refuses to end otherwise.
    ///
    /// # Errors
    /// [`Error::Invalid`](crate::Error::Invalid) if number or digest differ from `given`, and as `finish`.
    pub fn finish_with_same_records(mut self, given: &End, report: StageReport) -> Result<W> {
        self.cut()?;
        if self.tally != given.tally {
            return Err(crate::Error::Invalid(format!(
                "{} records with digest {} were read, but {} with {} would be written: this is a bug",
                given.tally.records, given.tally.digest, self.tally.records, self.tally.digest
            )));
        }
        let mut stages = given.stages.clone();
        stages.push(report);
        self.blocks.finish(&End { tally: self.tally, stages })
    }
}
