//! Traces, read a block at a time.

use super::access::{Access, TraceSink};
use super::decode::decode_searches;
use super::kept::Kept;
use crate::container::{Block, BlockMeta, BlockReader, End, Header, StreamKind};
use crate::digest::Tally;
use crate::error::Result;
use crate::region::check_regions;
use std::io::Read;

/// Reads a trace and replays it into a [`TraceSink`].
pub struct TraceReader<R> {
    blocks: BlockReader<R>,
    tally: Tally,
    /// Read by [`next_archived`](Self::next_archived), and not yet handed out.
    ahead: Option<Block>,
}

impl<R: Read> TraceReader<R> {
    /// Reads the header; the stream must be a trace.
    ///
    /// # Errors
    /// As [`BlockReader::new`], [`Error::WrongKind`](crate::Error::WrongKind), and [`Error::Damaged`](crate::Error::Damaged) for regions that make no sense.
    pub fn new(input: R) -> Result<Self> {
        Self::from_blocks(BlockReader::new(input)?)
    }

    /// Goes on from a stream whose header has been read.
    ///
    /// # Errors
    /// [`Error::WrongKind`](crate::Error::WrongKind), and [`Error::Damaged`](crate::Error::Damaged) for regions that make no sense.
    pub fn from_blocks(blocks: BlockReader<R>) -> Result<Self> {
        let blocks = blocks.expect_kind(StreamKind::Trace)?;
        match check_regions(&blocks.header().regions) {
            Ok(()) => Ok(Self { blocks, tally: Tally::default(), ahead: None }),
            Err(what) => Err(blocks.damaged(what)),
        }
    }

    /// What the trace is about.
    #[must_use]
    pub const fn header(&self) -> &Header {
        self.blocks.header()
    }

    /// What was read so far; records are searches.
    #[must_use]
    pub const fn tally(&self) -> Tally {
        self.tally
    }

    /// Replays the next block; `None` at the end. Only a whole trace has an end.
    ///
    /// # Errors
    /// As [`BlockReader::next_block`] and [`BlockReader::end`].
    pub fn replay_block(&mut self, sink: &mut impl TraceSink) -> Result<Option<BlockMeta>> {
        let Some(block) = self.blocks.next_block()? else {
            self.blocks.end(self.tally)?;
            return Ok(None);
        };
        let tally = decode_searches(&block, &self.blocks.header().regions, sink)
            .ok_or_else(|| self.blocks.damaged("a block does not hold its searches"))?;
        self.tally += tally;
        Ok(Some(block.meta))
    }

    /// The next block as it is kept in an archive, and what it adds to the digest; `None` at the end. It is smaller, holds the
    /// searches of several blocks of a batch, and is much slower to write; searches and digest are the same.
    ///
    /// # Errors
    /// As [`replay_block`](Self::replay_block).
    pub fn next_archived(&mut self) -> Result<Option<(Block, Tally)>> {
        let mut kept = Kept::default();
        loop {
            let block = match self.ahead.take() {
                Some(block) => Some(block),
                None => self.blocks.next_block()?,
            };
            let Some(block) = block else { break };
            let regions = &self.blocks.header().regions;
            if !kept.has_room_for(&block, regions) {
                self.ahead = Some(block);
                break;
            }
            let tally = decode_searches(&block, regions, &mut Nobody)
                .ok_or_else(|| self.blocks.damaged("a block does not hold its searches"))?;
            kept.push(block, tally, regions);
        }
        let Some((block, tally)) = kept.finish(&self.blocks.header().regions)? else {
            self.blocks.end(self.tally)?;
            return Ok(None);
        };
        self.tally += tally;
        Ok(Some((block, tally)))
    }

    /// The end block, after [`replay_block`](Self::replay_block) has returned `None`.
    ///
    /// # Errors
    /// [`Error::Incomplete`](crate::Error::Incomplete) before that.
    pub fn end(&self) -> Result<&End> {
        self.blocks.end(self.tally)
    }
}

/// Whom searches are told that are only to be checked.
struct Nobody;

impl TraceSink for Nobody {
    fn access(&mut self, _: Access) {}
}
