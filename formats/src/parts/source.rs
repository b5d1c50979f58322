//! One part, a block ahead.

use super::PartsError;
use super::header::part_of;
use crate::beside::tally_beside;
use crate::container::{Block, BlockReader, End, Section, StreamKind};
use crate::digest::Tally;
use crate::error::Error;
use crate::record::{Query, decode_checked};
use crate::region::check_regions;
use crate::trace::{TraceSink, decode_searches};
use crate::vocabulary::Part;
use std::io::Read;

/// One part of a stream.
pub(super) struct Source<R> {
    pub(super) name: String,
    pub(super) part: Part,
    blocks: BlockReader<R>,
    /// The block read ahead; nothing before the first is read, and at the end.
    ahead: Option<Block>,
    /// Batch of the last records.
    last: Option<u64>,
    tally: Tally,
}

impl<R: Read> Source<R> {
    pub(super) fn new(name: String, blocks: BlockReader<R>) -> Result<Self, PartsError> {
        let part =
            part_of(blocks.header()).ok_or_else(|| PartsError::Unfit(format!("{name}: not a part of a stream")))?;
        let mut source = Self { name, part, blocks, ahead: None, last: None, tally: Tally::default() };
        if source.blocks.kind() == StreamKind::Trace
            && let Err(what) = check_regions(&source.blocks.header().regions)
        {
            return Err(source.damaged(what));
        }
        source.read()?;
        Ok(source)
    }

    fn of_stream(&self, error: Error) -> PartsError {
        PartsError::Stream { name: self.name.clone(), error }
    }

    fn damaged(&self, what: &'static str) -> PartsError {
        self.of_stream(self.blocks.damaged(what))
    }

    /// Reads a block ahead.
    fn read(&mut self) -> Result<(), PartsError> {
        self.ahead = self.blocks.next_block().map_err(|error| self.of_stream(error))?;
        if self.ahead.is_none() {
            self.blocks.end(self.tally).map_err(|error| self.of_stream(error))?;
        }
        Ok(())
    }

    /// The batch of the next records, if there are more.
    pub(super) fn batch(&mut self) -> Result<Option<u64>, PartsError> {
        let Some(block) = &self.ahead else { return Ok(None) };
        let batch = block.meta.batch;
        if !self.part.has(batch) {
            return Err(self.damaged("a batch that another part has"));
        }
        if self.last.is_some_and(|last| batch < last) {
            return Err(self.damaged("the batches of a part are out of order"));
        }
        Ok(Some(batch))
    }

    /// The next block of records and what it adds to the digest.
    pub(super) fn take(&mut self, sink: &mut impl TraceSink) -> Result<(Block, Tally), PartsError> {
        let block = self.ahead.take().expect("a part is asked for a block that it has");
        let header = self.blocks.header();
        let tally = match self.blocks.kind() {
            StreamKind::Trace => {
                decode_searches(&block, &header.regions, sink).ok_or("a block does not hold its searches")
            }
            _ => decode_checked::<Query>(&block, header).map(|(_, tally)| tally),
        };
        let tally = tally.map_err(|what| self.damaged(what))?;
        self.last = Some(block.meta.batch);
        self.tally += tally;
        self.read()?;
        Ok((block, tally))
    }

    /// The next block that stands beside the records, if that is what comes.
    pub(super) fn take_beside(&mut self) -> Result<Option<(Block, Tally)>, PartsError> {
        let Some(block) = self.ahead.take_if(|block| block.section != Section::Records) else { return Ok(None) };
        let tally = tally_beside(&block).filter(|_| self.blocks.kind() == StreamKind::Queries);
        let tally = tally.ok_or_else(|| self.damaged("a block beside the records does not hold what it says"))?;
        self.tally += tally;
        self.read()?;
        Ok(Some((block, tally)))
    }

    /// Its end, once it was read.
    pub(super) fn end(&self) -> Result<(&str, &End), PartsError> {
        let end = self.blocks.end(self.tally).map_err(|error| self.of_stream(error))?;
        Ok((&self.name, end))
    }
}
