//! What a cache lets through, as a trace of its own, so that caches can be chained.
//!
//! Each line that the cache fetches is a read of the whole line, in the search that missed; searches without a miss stay,
//! with their destinations, and so do batches and the warm-up flag. A region keeps its name and base; its records are now
//! lines, and its size is rounded up to whole ones (in lines longer than the 4 KiB that keep regions apart it is not, and
//! a read is cut where the region ends). Dirty lines that leave are writes, before the read that they make room for, if they
//! are asked for ([`Measures::write_backs`]); those that are there at the end have not left.

use std::io::Write;

use pm_formats::trace::{Access, AccessKind, BlockEncoder, Coding, REGION_ALIGNMENT, Region, TraceSink, TraceWriter};
use pm_formats::{BlockMeta, Header, StageReport};

use crate::simulation::Moved;
use crate::{CacheConfig, CacheCounts, Findings, Measures, Simulation, SimulationError};

/// Simulates one cache and writes what it fetches.
pub struct MissStream<W> {
    simulation: Simulation,
    line_bytes: u64,
    regions: Vec<Region>,
    writer: TraceWriter<W>,
    /// Destinations of the searches of the block in hand, and for each search the ends of its part of both lists.
    destinations: Vec<u32>,
    fetched: Vec<Moved>,
    searches: Vec<(usize, usize)>,
}

/// The most reads in a block, but for those of its last search; a block of more is written as several.
const BLOCK_READS: usize = 1 << 20;

/// A region whose records are lines.
pub(crate) fn hold_lines(region: &mut Region, line_bytes: u32) {
    if region.is_addresses() {
        return;
    }
    region.coding = Coding::Records;
    region.record_size = line_bytes;
    if u64::from(line_bytes) <= REGION_ALIGNMENT {
        region.size = region.size.next_multiple_of(line_bytes.into());
    }
}

/// The read that fetches a line, or the write of one that leaves, cut to its region, one of such.
pub(crate) fn access_of(regions: &[Region], line_bytes: u64, Moved { region, line, written }: Moved) -> Access {
    let region_of = &regions[usize::from(region)];
    let base = region_of.base;
    let end = if region_of.is_addresses() { u64::MAX } else { base + (region_of.size - 1) };
    let first = (line * line_bytes).max(base);
    let last = (line * line_bytes + (line_bytes - 1)).min(end);
    // A line of 2 GiB still fits.
    let read = Access::read(region, first - base, (last - first + 1) as u32);
    if written { Access { kind: AccessKind::Write, ..read } } else { read }
}

impl<W: Write> MissStream<W> {
    /// A stream of what `config` fetches of a trace with this header. `measures` are found besides. The header is that of
    /// the new stream but for its regions.
    ///
    /// # Errors
    /// If there can be no such simulation, or the header cannot be written.
    pub fn new(
        output: W,
        mut header: Header,
        config: CacheConfig,
        measures: &Measures,
    ) -> Result<Self, MissStreamError> {
        if !config.keeps_lines() {
            return Err(MissStreamError::NoCache(config));
        }
        let mut simulation = Simulation::measuring(&header.regions, &[config], measures)?;
        simulation.keep_fetched();
        let line_bytes = u64::from(config.line_bytes());
        header.regions.iter_mut().for_each(|region| hold_lines(region, config.line_bytes()));
        Ok(Self {
            simulation,
            line_bytes,
            regions: header.regions.clone(),
            writer: TraceWriter::new(output, &header)?,
            destinations: vec![],
            fetched: vec![],
            searches: vec![],
        })
    }

    /// Whether all went well so far: [`Simulation::check`].
    ///
    /// # Errors
    /// If not.
    pub fn check(&self) -> Result<(), SimulationError> {
        self.simulation.check()
    }

    /// Writes the block that was replayed last.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn end_block(&mut self, meta: BlockMeta) -> pm_formats::Result<()> {
        let (mut destination, mut read) = (0, 0);
        let mut searches = self.searches.iter().peekable();
        // A block without searches stays one.
        loop {
            let mut encoder = BlockEncoder::new(&self.regions);
            let from = read;
            while let Some(&(destinations, reads)) = searches.next_if(|_| read - from < BLOCK_READS) {
                encoder.begin(&self.destinations[destination..destinations]);
                self.fetched[read..reads]
                    .iter()
                    .for_each(|&fetch| encoder.access(access_of(&self.regions, self.line_bytes, fetch)));
                encoder.end();
                (destination, read) = (destinations, reads);
            }
            let (block, tally) = encoder.finish(meta)?;
            self.writer.write(&block, tally)?;
            if searches.peek().is_none() {
                break;
            }
        }
        self.destinations.clear();
        self.fetched.clear();
        self.searches.clear();
        Ok(())
    }

    /// Writes the end block with what each stage measured, this one included, which knows the cache's row. Returns the
    /// output and all that the simulation found.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn finish(self, stages: impl FnOnce(&CacheCounts) -> Vec<StageReport>) -> pm_formats::Result<(W, Findings)> {
        let findings = self.simulation.findings();
        Ok((self.writer.finish(stages(&findings.caches[0]))?, findings))
    }
}

impl<W> TraceSink for MissStream<W> {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.simulation.block(batch, warm_up);
    }

    fn search(&mut self, destinations: &[u32]) {
        self.simulation.search(destinations);
        self.destinations.extend(destinations);
    }

    #[inline]
    fn access(&mut self, access: Access) {
        self.simulation.access(access);
    }

    fn search_end(&mut self) {
        self.simulation.search_end();
        self.simulation.take_fetched(&mut self.fetched);
        self.searches.push((self.destinations.len(), self.fetched.len()));
    }
}

/// Why what a cache fetches cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum MissStreamError {
    /// There is no cache that would keep anything back.
    #[error("{0}: without a cache nothing is kept back; name one that has lines")]
    NoCache(CacheConfig),
    /// The cache cannot be simulated.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    /// The stream cannot be written.
    #[error(transparent)]
    Format(#[from] pm_formats::Error),
}
