//! A foreign trace as a stream of ours.

use super::Trace;
use pm_formats::trace::{Access, BlockEncoder, Region, TraceSink, TraceWriter};
use pm_formats::vocabulary::meaning;
use pm_formats::{Header, Step};
use std::io::Write;

/// The header of a stream that a foreign trace becomes, or what a cache fetches of it: its order is its format's word.
#[must_use]
pub fn header_of(trace: &Trace, step: Step) -> Header {
    let mut header = Header { regions: trace.regions().to_vec(), ..Header::empty() };
    header.set_meaning(meaning::ORDER, trace.format().word());
    header.history.push(step);
    header
}

/// Writes a foreign trace as a stream of ours: the accesses in order, their kinds and sizes, those of its warm-up as such.
///
/// # Errors
/// What is wrong with the trace; what the output reports.
pub fn archive<W: Write>(trace: &mut Trace, header: &Header, output: W) -> anyhow::Result<W> {
    let mut writer = TraceWriter::new(output, header)?;
    let mut block = Coder { regions: &header.regions, encoder: BlockEncoder::new(&header.regions) };
    trace.replay_blocks(&mut block, |block, meta| {
        let encoder = std::mem::replace(&mut block.encoder, BlockEncoder::new(block.regions));
        let (coded, tally) = encoder.finish(meta)?;
        Ok(writer.write(&coded, tally)?)
    })?;
    Ok(writer.finish(vec![])?)
}

/// Codes the block in hand.
struct Coder<'a> {
    regions: &'a [Region],
    encoder: BlockEncoder<'a>,
}

impl TraceSink for Coder<'_> {
    fn search(&mut self, destinations: &[u32]) {
        self.encoder.begin(destinations);
    }
    fn access(&mut self, access: Access) {
        self.encoder.access(access);
    }
    fn search_end(&mut self) {
        self.encoder.end();
    }
}
