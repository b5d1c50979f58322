//! All caches in one reading of a trace.

use std::collections::BTreeMap;

use pm_formats::trace::{Access, Region, TraceSink};
use thiserror::Error;

use super::{
    CacheConfig, Policy, RecordCounts, Row,
    lines::{Cursor, LineChunk, LineSpace},
    lru_stack::{LruStack, MAX_SIZES},
    model::{CacheModel, Tally},
    optimum::{Bypass, FewWays, OneSet, Optimum},
    records::{Batch, CHUNK, Records},
    replacement::{Clock, Fifo, LruOrder, LruTimes, Random, Replacement, TreePlru},
    set_associative::{MAX_FRAMES, SetAssociative, Sets, frames_of},
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
///
/// # Panics
///
/// Whoever replays a trace has checked that each access lies within its region. One that does not ends in a panic, with
/// one of the accesses after it or at the end, rather than in a count of the wrong line.
pub struct Simulation {
    regions: Vec<Region>,
    /// Caches of one line size share its line accesses.
    stages: Vec<Stage>,
    configs: Vec<CacheConfig>,
    /// Accesses not yet simulated, all of one kind of block.
    records: Records,
    warm_up: bool,
    queries: u64,
    searches: u64,
    record_counts: Vec<RecordCounts>,
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
    #[error(
        "{0} has too many lines: at most {MAX_FRAMES} in sets, with ways rounded up to a power of two; full has no limit"
    )]
    TooManyFrames(CacheConfig),
}

/// Lines of all regions that can be simulated: half of what 32 bits tell apart, so that the times of the LRU stack, one
/// for each line at least, leave room for time to pass.
const MAX_LINES: u64 = 1 << 31;

impl Simulation {
    /// Prepares to simulate `configs` on a trace of these regions.
    ///
    /// # Errors
    ///
    /// If the regions have more than 2^31 lines, or reach past the last address, or a set-associative cache has more
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
            regions: regions.to_vec(),
            stages: by_line.into_iter().map(stage).collect::<Result<_, _>>()?,
            configs: configs.to_vec(),
            records: Records::new(chunk),
            warm_up: false,
            queries: 0,
            searches: 0,
            record_counts: vec![RecordCounts::default(); regions.len()],
        })
    }

    /// Simulates what is waiting.
    #[inline(never)]
    fn flush(&mut self) {
        let batch = self.records.batch();
        assert!(batch.are_within(&self.regions), "the trace's reader let through an access outside of its region");
        if !self.warm_up {
            batch.count(&mut self.record_counts);
        }
        for stage in &mut self.stages {
            stage.run(&batch, !self.warm_up);
        }
        self.records.clear();
    }

    /// Ends the simulation: one row for each configuration, in the order they were given.
    ///
    /// # Panics
    ///
    /// As an access may: see [`Simulation`].
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

    /// Bytes of all regions over bytes of a line, rounded up.
    fn blocks(&self, line: u64) -> u64 {
        // 2^16 sizes may add up to more than 64 bits; their lines were checked to be few.
        let bytes: u128 = self.regions.iter().map(|r| u128::from(r.size)).sum();
        bytes.div_ceil(line.into()) as u64
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
            blocks: self.blocks(line),
            region_fetches,
        }
    }
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

    #[inline]
    fn access(&mut self, access: Access) {
        if !self.records.push(&access) {
            self.flush();
            self.records.push(&access);
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
            let (cache, only) = (configs[config], CacheOfModel { config, tally: 0 });
            match (cache.policy(), cache.sets()) {
                (Policy::None, _) => uncached.push(only),
                // A single set is fully associative, whatever it is called.
                (Policy::Lru, 1) => full.entry(cache.lines()).or_default().push(config),
                _ => models.push((in_sets(cache, &space, regions.len())?, vec![only])),
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
        Ok(Self { space, chunk: LineChunk::default(), accesses: 0, models })
    }

    fn run(&mut self, batch: &Batch, counted: bool) {
        let mut cursor = Cursor::default();
        while self.chunk.split(&self.space, batch, &mut cursor) {
            if counted {
                self.accesses += self.chunk.accesses();
            }
            for (model, _) in &mut self.models {
                model.run(&self.space, &self.chunk, counted);
            }
        }
    }
}

/// The model of one cache that is not uncached, nor fully associative under LRU.
fn in_sets(cache: CacheConfig, space: &LineSpace, regions: usize) -> Result<Box<dyn CacheModel>, SimulationError> {
    let ways = match cache.sets() {
        // One set never holds more lines than there are. No more frames than needed, then; plru needs a power of two.
        1 => cache.lines().min(space.slots().max(1).next_power_of_two()),
        sets => cache.lines() / sets,
    };
    if frames_of(cache.sets(), ways) > MAX_FRAMES {
        return Err(SimulationError::TooManyFrames(cache));
    }
    let sets = Sets::new(cache.sets(), cache.index());
    let cache_of = CacheInSets { space, regions, sets, ways: ways as usize };
    let (sets, ways) = (sets.number(), ways as usize);
    Ok(match cache.policy() {
        Policy::None => unreachable!("no cache is no model of sets"),
        Policy::Lru if ways <= LruOrder::WAYS => cache_of.replacing(LruOrder::new(sets, ways)),
        Policy::Lru => cache_of.replacing(LruTimes::new(sets, ways)),
        Policy::Fifo => cache_of.replacing(Fifo::new(sets, ways)),
        Policy::Clock => cache_of.replacing(Clock::new(sets, ways)),
        Policy::Random { seed } => cache_of.replacing(Random::new(seed, ways)),
        Policy::TreePlru => cache_of.replacing(TreePlru::new(sets, ways)),
        Policy::Min => cache_of.optimum(Bypass::Never),
        Policy::MinBypass => cache_of.optimum(Bypass::Allowed),
    })
}

/// A cache but for its policy.
struct CacheInSets<'a> {
    space: &'a LineSpace,
    regions: usize,
    sets: Sets,
    ways: usize,
}

impl CacheInSets<'_> {
    fn replacing<R: Replacement + 'static>(self, replacement: R) -> Box<dyn CacheModel> {
        Box::new(SetAssociative::new(self.space, self.regions, self.sets, self.ways, replacement))
    }

    fn optimum(self, bypass: Bypass) -> Box<dyn CacheModel> {
        let slots = self.space.slots() as usize;
        if self.sets.number() == 1 {
            Box::new(Optimum::new(self.regions, bypass, OneSet::new(slots, self.ways, bypass)))
        } else {
            Box::new(Optimum::new(self.regions, bypass, FewWays::new(slots, self.sets, self.ways, bypass)))
        }
    }
}
