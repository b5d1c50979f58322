//! All caches in one reading of a trace.

use std::collections::BTreeMap;

use pm_formats::trace::{Access, AccessKind, Region, TraceSink};
use thiserror::Error;

use super::{
    CacheConfig, Policy, RecordCounts, Row, Ways,
    lines::{LineChunk, LineSpace, Record, Rest},
    lru_stack::{LruStack, MAX_SIZES},
    model::{CacheModel, Tally},
    replacement::Lru,
    set_associative::{MAX_FRAMES, SetAssociative},
    uncached::Uncached,
};

/// Runs caches over a trace that is replayed into it.
///
/// ```
/// use pm_formats::trace::{Access, Coding, TraceSink, lay_out};
/// use pm_tools::cache::Simulation;
///
/// let regions = lay_out([("photons".to_owned(), 1000, 20, Coding::Records)]);
/// let caches = ["128K,full,128,lru".parse().unwrap(), "none".parse().unwrap()];
/// let mut simulation = Simulation::new(&regions, &caches).unwrap();
/// simulation.block(0, false);
/// simulation.search(&[7]);
/// for photon in [0, 1, 6, 0] {
///     simulation.access(Access::read(0, photon * 20, 20)); // photon 6 spans lines 0 and 1
/// }
/// simulation.search_end();
/// let rows = simulation.finish();
/// assert_eq!((rows[0].accesses, rows[0].fetches, rows[0].bytes_fetched), (5, 2, 256));
/// assert_eq!((rows[1].fetches, rows[1].bytes_fetched), (4, 80));
/// ```
pub struct Simulation {
    regions: Vec<Bounds>,
    /// Caches of one line size share its line accesses.
    stages: Vec<Stage>,
    configs: Vec<CacheConfig>,
    /// Bytes of all regions; wider than a sum of 2^16 sizes can get.
    region_bytes: u128,
    /// Accesses not yet simulated, all of one kind of block.
    records: Vec<Record>,
    warm_up: bool,
    queries: u64,
    searches: u64,
    record_counts: Vec<RecordCounts>,
}

/// What the simulation needs to know of a region.
#[derive(Clone, Copy)]
struct Bounds {
    base: u64,
    size: u64,
}

/// The line accesses of one line size and the caches they run through.
struct Stage {
    space: LineSpace,
    chunk: LineChunk,
    accesses: u64,
    models: Vec<(Box<dyn CacheModel>, Vec<CacheOfModel>)>,
}

/// One configuration that a model answers for.
struct CacheOfModel {
    /// Index into the configurations.
    config: usize,
    /// Index into the model's tallies.
    tally: usize,
}

/// Why caches cannot be simulated on a trace.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SimulationError {
    /// The regions are too large to keep a table of their lines.
    #[error("the trace's regions have {lines} lines of {line_bytes} bytes; at most {MAX_LINES} can be simulated")]
    TooManyLines {
        /// Lines of all regions.
        lines: u64,
        /// The line size, in bytes.
        line_bytes: u32,
    },
    /// A region ends beyond the last address.
    #[error("region {region} of the trace ends beyond the last 64-bit address")]
    RegionBeyondAddresses {
        /// Index of the region.
        region: usize,
    },
    /// More regions than an access can name.
    #[error("the trace has {0} regions; at most 65536 can be told apart")]
    TooManyRegions(usize),
    /// A set-associative cache larger than the tables allow.
    #[error("{0} has too many lines: at most {MAX_FRAMES} in sets; full has no limit")]
    TooManyFrames(CacheConfig),
}

/// Lines of all regions that can be simulated: their numbers and a few marks fit 32 bits.
const MAX_LINES: u64 = u32::MAX as u64 - 2;

/// Accesses simulated at a time: few enough for them and their line accesses to stay in a core's own cache, enough that
/// most uses are dead when the LRU stack looks back at them.
const CHUNK: usize = 4096;

impl Simulation {
    /// Prepares to simulate `configs` on a trace of these regions.
    ///
    /// # Errors
    ///
    /// If the regions have more than about 2^32 lines, or reach past the last address, or a set-associative cache has more
    /// than about 2^32 lines.
    pub fn new(regions: &[Region], configs: &[CacheConfig]) -> Result<Self, SimulationError> {
        Self::with_chunk(regions, configs, CHUNK)
    }

    /// The same with so many accesses simulated at a time.
    pub(super) fn with_chunk(
        regions: &[Region],
        configs: &[CacheConfig],
        chunk: usize,
    ) -> Result<Self, SimulationError> {
        if regions.len() > 1 << 16 {
            return Err(SimulationError::TooManyRegions(regions.len()));
        }
        if let Some(region) = regions.iter().position(|r| r.size > 0 && r.base.checked_add(r.size - 1).is_none()) {
            return Err(SimulationError::RegionBeyondAddresses { region });
        }
        let mut by_line: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (i, config) in configs.iter().enumerate() {
            by_line.entry(config.line_bytes()).or_default().push(i);
        }
        let stage = |(line_bytes, members): (u32, Vec<usize>)| Stage::new(line_bytes, &members, configs, regions);
        Ok(Self {
            regions: regions.iter().map(|r| Bounds { base: r.base, size: r.size }).collect(),
            stages: by_line.into_iter().map(stage).collect::<Result<_, _>>()?,
            configs: configs.to_vec(),
            region_bytes: regions.iter().map(|r| u128::from(r.size)).sum(),
            records: Vec::with_capacity(chunk),
            warm_up: false,
            queries: 0,
            searches: 0,
            record_counts: vec![RecordCounts::default(); regions.len()],
        })
    }

    /// Simulates what is waiting.
    #[inline(never)]
    fn flush(&mut self) {
        if !self.warm_up {
            count(&self.records, &mut self.record_counts);
        }
        for stage in &mut self.stages {
            stage.run(&self.records, !self.warm_up);
        }
        self.records.clear();
    }

    /// Ends the simulation: one row for each configuration, in the order they were given.
    #[must_use]
    pub fn finish(mut self) -> Vec<Row> {
        self.flush();
        let mut records = RecordCounts::default();
        self.record_counts.iter().for_each(|counts| records.add(counts));
        let mut rows = vec![None; self.configs.len()];
        for stage in std::mem::take(&mut self.stages) {
            for (model, caches) in stage.models {
                let tallies = model.finish();
                for cache in caches {
                    let config = self.configs[cache.config];
                    rows[cache.config] = Some(self.row(config, stage.accesses, records, &tallies[cache.tally]));
                }
            }
        }
        rows.into_iter().flatten().collect()
    }

    fn row(&self, config: CacheConfig, accesses: u64, records: RecordCounts, tally: &Tally) -> Row {
        let line = u64::from(config.line_bytes());
        let cached = config.policy() != Policy::None;
        let region_fetches = if cached {
            tally.fetches.clone()
        } else {
            self.record_counts.iter().map(|counts| counts.reads + counts.read_modify_writes).collect()
        };
        let fetches = region_fetches.iter().sum();
        Row {
            config,
            queries: self.queries,
            searches: self.searches,
            records,
            accesses,
            fetches,
            bytes_fetched: if cached { fetches * line } else { records.bytes_read },
            bytes_written_back: if cached { tally.write_backs * line } else { records.bytes_written },
            compulsory: tally.compulsory,
            // Fits: no more than the lines of the regions, which were checked to be few.
            blocks: self.region_bytes.div_ceil(line.into()) as u64,
            region_fetches,
        }
    }
}

/// An access that a reader should have refused.
#[cold]
#[inline(never)]
fn outside(access: Access) -> ! {
    panic!("the trace's reader let through an access outside of its region: {access:?}")
}

impl TraceSink for Simulation {
    fn block(&mut self, _batch: u64, warm_up: bool) {
        if warm_up != self.warm_up {
            self.flush();
            self.warm_up = warm_up;
        }
    }

    fn search(&mut self, destinations: &[u32]) {
        if !self.warm_up {
            self.searches += 1;
            self.queries += destinations.len() as u64;
        }
    }

    /// # Panics
    ///
    /// If the access is not within its region: whoever replays a trace has checked that.
    #[inline]
    fn access(&mut self, access: Access) {
        let Access { kind, region, len, offset } = access;
        let Some(&Bounds { base, size }) = self.regions.get(usize::from(region)) else { outside(access) };
        if offset >= size || u64::from(len) > size - offset {
            outside(access);
        }
        if self.records.len() == self.records.capacity() {
            self.flush();
        }
        self.records.push(Record { address: base + offset, len, region, kind });
    }
}

/// Adds up records by region and kind.
fn count(records: &[Record], counts: &mut [RecordCounts]) {
    // Neighbours are mostly alike: summed in registers, not in memory.
    for run in records.chunk_by(|a, b| a.region == b.region && a.kind == b.kind) {
        let counts = &mut counts[usize::from(run[0].region)];
        let number = run.len() as u64;
        let bytes: u64 = run.iter().map(|record| u64::from(record.len)).sum();
        match run[0].kind {
            AccessKind::Read => counts.reads += number,
            AccessKind::Write => counts.writes += number,
            AccessKind::ReadModifyWrite => counts.read_modify_writes += number,
        }
        if run[0].kind != AccessKind::Write {
            counts.bytes_read += bytes;
        }
        if run[0].kind != AccessKind::Read {
            counts.bytes_written += bytes;
        }
    }
}

impl Stage {
    fn new(
        line_bytes: u32,
        members: &[usize],
        configs: &[CacheConfig],
        regions: &[Region],
    ) -> Result<Self, SimulationError> {
        let space = LineSpace::new(regions, line_bytes);
        if space.slots() > MAX_LINES {
            return Err(SimulationError::TooManyLines { lines: space.slots(), line_bytes });
        }
        let mut models: Vec<(Box<dyn CacheModel>, Vec<CacheOfModel>)> = Vec::new();
        let mut uncached = Vec::new();
        // Fully associative LRU by lines held: one stack for all sizes.
        let mut full: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        for &config in members {
            match (configs[config].policy(), configs[config].ways(), configs[config].lines()) {
                (Policy::None, ..) => uncached.push(CacheOfModel { config, tally: 0 }),
                (Policy::Lru, Ways::Full, lines) => full.entry(lines).or_default().push(config),
                // A single set is fully associative, and the stack is faster.
                (Policy::Lru, Ways::N(ways), lines) if u64::from(ways.get()) == lines => {
                    full.entry(lines).or_default().push(config);
                }
                (Policy::Lru, Ways::N(ways), lines) => {
                    if lines > MAX_FRAMES {
                        return Err(SimulationError::TooManyFrames(configs[config]));
                    }
                    let ways = ways.get() as usize;
                    let model = SetAssociative::<Lru>::new(&space, regions.len(), lines as usize / ways, ways);
                    models.push((Box::new(model), vec![CacheOfModel { config, tally: 0 }]));
                }
            }
        }
        if !uncached.is_empty() {
            models.push((Box::new(Uncached::new(&space)), uncached));
        }
        let sizes: Vec<(u64, Vec<usize>)> = full.into_iter().collect();
        for sizes in sizes.chunks(MAX_SIZES) {
            let lines: Vec<u64> = sizes.iter().map(|(lines, _)| *lines).collect();
            let caches = sizes
                .iter()
                .enumerate()
                .flat_map(|(tally, (_, configs))| configs.iter().map(move |&config| CacheOfModel { config, tally }));
            models.push((Box::new(LruStack::new(&space, regions.len(), &lines)), caches.collect()));
        }
        Ok(Self { space, chunk: LineChunk::new(), accesses: 0, models })
    }

    fn run(&mut self, records: &[Record], counted: bool) {
        let mut rest = Rest::from(records);
        while self.chunk.split(&self.space, &mut rest) {
            if counted {
                self.accesses += self.chunk.accesses();
            }
            for (model, _) in &mut self.models {
                model.run(&self.space, &self.chunk, counted);
            }
        }
    }
}
