//! Streams of records, read a block at a time.

use crate::beside::tally_beside;
use crate::container::{Block, BlockMeta, BlockReader, End, Header, Section};
use crate::digest::Tally;
use crate::error::Result;
use crate::record::{Record, decode_checked};
use std::io::Read;
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
