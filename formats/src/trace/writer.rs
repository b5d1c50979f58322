//! Traces, written a block at a time.

use crate::container::{Block, BlockWriter, End, Header, StageReport, StreamKind};
use crate::digest::Tally;
use crate::error::{Error, Result};
use crate::region::check_regions;
use std::io::Write;

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
