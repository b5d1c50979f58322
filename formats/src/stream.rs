//! Typed streams of records: what most programs read and write.

use crate::beside::tally_beside;
use crate::container::{Block, BlockMeta, BlockReader, BlockWriter, End, Header, Section, StageReport};
use crate::digest::Tally;
use crate::error::Result;
use crate::record::{BLOCK_RECORDS, Record, decode_checked, encode_records};
use std::io::{Read, Write};
use std::marker::PhantomData;

/// Reads records of one kind, a block at a time.
pub struct RecordReader<T, R> {
    blocks: BlockReader<R>,
    tally: Tally,
    beside: Vec<(Block, Tally)>,
    records: PhantomData<T>,
}

impl<T: Record, R: Read> RecordReader<T, R> {
    /// Reads the header; the stream must hold records `T`.
    ///
    /// # Errors
    /// As [`BlockReader::new`], and [`Error::WrongKind`](crate::Error::WrongKind).
    pub fn new(input: R) -> Result<Self> {
        Self::from_blocks(BlockReader::new(input)?)
    }

    /// Goes on from a stream whose header has been read.
    ///
    /// # Errors
    /// [`Error::WrongKind`](crate::Error::WrongKind) if it holds other records.
    pub fn from_blocks(blocks: BlockReader<R>) -> Result<Self> {
        let blocks = blocks.expect_kind(T::KIND)?;
        Ok(Self { blocks, tally: Tally::default(), beside: vec![], records: PhantomData })
    }

    /// What the stream is about.
    #[must_use]
    pub const fn header(&self) -> &Header {
        self.blocks.header()
    }

    /// What was read so far.
    #[must_use]
    pub const fn tally(&self) -> Tally {
        self.tally
    }

    /// The next block's records, or `None` at the end; only a whole stream has an end.
    ///
    /// # Errors
    /// As [`BlockReader::next_block`] and [`BlockReader::end`].
    pub fn next_block(&mut self) -> Result<Option<(BlockMeta, Vec<T>)>> {
        let block = loop {
            match self.blocks.next_block()? {
                Some(block) if block.section == Section::Records => break block,
                Some(block) => {
                    let damaged = || self.blocks.damaged("a block beside the records does not hold what it says");
                    let tally = tally_beside(&block).ok_or_else(damaged)?;
                    self.tally += tally;
                    self.beside.push((block, tally));
                }
                None => {
                    self.blocks.end(self.tally)?;
                    return Ok(None);
                }
            }
        };
        let decoded = decode_checked::<T>(&block, self.blocks.header());
        let (records, tally) = decoded.map_err(|what| self.blocks.damaged(what))?;
        self.tally += tally;
        Ok(Some((block.meta, records)))
    }

    /// The blocks that stood beside the records read since this was asked last, with what each adds to the digest.
    /// Whoever passes the records on passes them on as well.
    pub fn take_beside(&mut self) -> Vec<(Block, Tally)> {
        std::mem::take(&mut self.beside)
    }

    /// The end block, after [`next_block`](Self::next_block) has returned `None`.
    ///
    /// # Errors
    /// [`Error::Incomplete`](crate::Error::Incomplete) before that.
    pub fn end(&self) -> Result<&End> {
        self.blocks.end(self.tally)
    }
}

/// Writes records of one kind, cutting blocks at [`BLOCK_RECORDS`] and wherever the batch changes.
pub struct RecordWriter<T, W> {
    blocks: BlockWriter<W>,
    meta: BlockMeta,
    held: Vec<T>,
    tally: Tally,
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
        })
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
        if !self.held.is_empty() {
            let (block, tally) = encode_records(self.meta, &self.held)?;
            self.blocks.write(&block)?;
            self.tally += tally;
            self.held.clear();
        }
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
