//! Trace streams: blocks of searches.

use super::access::{Coding, Region, TraceSink};
use super::decode::decode_searches;
use super::heap_walk::MAX_NODES;
use crate::container::{Block, BlockMeta, BlockReader, BlockWriter, End, Header, StageReport, StreamKind};
use crate::digest::Tally;
use crate::error::{Error, Result};
use std::io::{Read, Write};

/// Reads a trace and replays it into a [`TraceSink`].
pub struct TraceReader<R> {
    blocks: BlockReader<R>,
    tally: Tally,
}

impl<R: Read> TraceReader<R> {
    /// Reads the header; the stream must be a trace.
    ///
    /// # Errors
    /// As [`BlockReader::new`], [`Error::WrongKind`], and [`Error::Damaged`] for regions that make no sense.
    pub fn new(input: R) -> Result<Self> {
        Self::from_blocks(BlockReader::new(input)?)
    }

    /// Goes on from a stream whose header has been read.
    ///
    /// # Errors
    /// [`Error::WrongKind`], and [`Error::Damaged`] for regions that make no sense.
    pub fn from_blocks(blocks: BlockReader<R>) -> Result<Self> {
        let blocks = blocks.expect_kind(StreamKind::Trace)?;
        match check_regions(&blocks.header().regions) {
            Ok(()) => Ok(Self { blocks, tally: Tally::default() }),
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

    /// The end block, after [`replay_block`](Self::replay_block) has returned `None`.
    ///
    /// # Errors
    /// [`Error::Incomplete`] before that.
    pub fn end(&self) -> Result<&End> {
        self.blocks.end(self.tally)
    }
}

/// Writes a trace; the blocks come from [`BlockEncoder`](super::BlockEncoder).
pub struct TraceWriter<W> {
    blocks: BlockWriter<W>,
    tally: Tally,
}

impl<W: Write> TraceWriter<W> {
    /// Writes the header.
    ///
    /// # Errors
    /// As [`BlockWriter::new`], and [`Error::Invalid`] for regions that make no sense.
    pub fn new(output: W, header: &Header) -> Result<Self> {
        check_regions(&header.regions).map_err(|what| Error::Invalid(what.into()))?;
        Ok(Self { blocks: BlockWriter::new(output, StreamKind::Trace, header)?, tally: Tally::default() })
    }

    /// Writes a block of searches.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn write(&mut self, block: &Block, tally: Tally) -> Result<()> {
        self.blocks.write(block)?;
        self.tally += tally;
        Ok(())
    }

    /// Writes the end block with what each stage measured.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn finish(self, stages: Vec<StageReport>) -> Result<W> {
        self.blocks.finish(&End { tally: self.tally, stages })
    }
}

/// Regions must lie apart, each on pages of its own, and be as large as their coding needs.
fn check_regions(regions: &[Region]) -> std::result::Result<(), &'static str> {
    if regions.len() > usize::from(u16::MAX) {
        return Err("a trace of more than 65,535 regions");
    }
    let mut spans = vec![];
    for region in regions {
        let end = region.base.checked_add(region.size).filter(|&end| end < 1 << 62);
        let end = end.ok_or("a region ends beyond the address space")?;
        if !region.base.is_multiple_of(super::REGION_ALIGNMENT) {
            return Err("a region does not begin on a page");
        }
        if let Coding::HeapWalk { nodes, .. } = region.coding {
            let needed = u64::from(nodes) * u64::from(region.record_size);
            if nodes > MAX_NODES || region.record_size == 0 || needed > region.size {
                return Err("a region is smaller than its nodes");
            }
        }
        spans.push((region.base, end.next_multiple_of(super::REGION_ALIGNMENT)));
    }
    spans.sort_unstable();
    if spans.windows(2).any(|pair| pair[0].1 > pair[1].0) {
        return Err("two regions share a page");
    }
    Ok(())
}
