//! All caches in one reading of a trace.

use std::{collections::BTreeMap, rc::Rc};

use pm_formats::trace::{Access, Region, TraceSink};
use thiserror::Error;

use super::{
    CacheConfig, ConfigError, Findings, Measures, More, Policy, RecordCounts, Row, TraceCounts,
    config::check_line,
    curve::CurveStack,
    lines::{Cursor, LineChunk, LineSpace},
    lru_stack::{LruStack, MAX_SIZES},
    misses::{Misses, PageSwitches},
    model::{CacheModel, Tally},
    optimum::{Bypass, FewWays, OneSet, Optimum},
    records::{Batch, CHUNK, Records},
    replacement::{Clock, Fifo, LruOrder, LruTimes, Random, Replacement, TreePlru},
    results::ResultTraffic,
    set_associative::{MAX_FRAMES, SetAssociative, Sets, frames_of},
    shards::Shards,
    uncached::Uncached,
    working_set::{Mark, WorkingSetCounter},
};

/// Runs caches over a trace that is replayed into it.
///
/// ```
/// use pm_formats::trace::{Access, Coding, TraceSink, lay_out};
/// use pm_caches::Simulation;
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
    /// How many of them are asked for; the others are twins.
    asked: usize,
    measures: Measures,
    /// Accesses not yet simulated, all of one kind of block.
    records: Records,
    /// Where searches that count begin among them, if somebody wants to know.
    marks: Vec<Mark>,
    batch: u64,
    warm_up: bool,
    results: Option<ResultTraffic>,
    /// Pages of records fetched without a cache.
    record_pages: Option<PageSwitches>,
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
    misses: Misses,
    curve: Option<CurveStack>,
    shards: Option<Shards>,
    working_sets: Option<WorkingSetCounter>,
    /// Region and line number of each fetch, if somebody collects them.
    fetched: Option<Vec<(u16, u64)>>,
}

/// One configuration that a model answers for.
struct CacheOfModel {
    /// Index into the configurations.
    config: usize,
    /// Index into the model's tallies.
    tally: usize,
    pages: Option<PageSwitches>,
}

impl CacheOfModel {
    fn new(config: usize, tally: usize) -> Self {
        Self { config, tally, pages: None }
    }
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
    /// A curve of lines that will not do.
    #[error(transparent)]
    Line(#[from] ConfigError),
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
        Self::measuring(regions, configs, &Measures::default())
    }

    /// The same, and finds out more on the way.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new), and if a line size will not do.
    pub fn measuring(
        regions: &[Region],
        configs: &[CacheConfig],
        measures: &Measures,
    ) -> Result<Self, SimulationError> {
        Self::with_chunk(regions, configs, measures, CHUNK)
    }

    /// The same with so many accesses simulated at a time.
    pub(super) fn with_chunk(
        regions: &[Region],
        configs: &[CacheConfig],
        measures: &Measures,
        chunk: usize,
    ) -> Result<Self, SimulationError> {
        if regions.len() > 1 << 16 {
            return Err(SimulationError::TooManyRegions(regions.len()));
        }
        if let Some(region) = regions.iter().position(|r| r.size > 0 && r.base.checked_add(r.size - 1).is_none()) {
            return Err(SimulationError::RegionBeyondAddresses { region });
        }
        let asked = configs.len();
        let mut configs = configs.to_vec();
        if measures.split {
            // The twins of the caches that are no fully associative LRU; one stack serves those of all sizes.
            configs.extend(configs.clone().iter().filter_map(CacheConfig::full_lru_twin));
        }
        let mut by_line: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (i, config) in configs.iter().enumerate() {
            by_line.entry(config.line_bytes()).or_default().push(i);
        }
        for &line in &measures.curves {
            by_line.entry(check_line(line.into())?).or_default();
        }
        let stage = |(line_bytes, members): (u32, Vec<usize>)| {
            let mut stage = Stage::new(line_bytes, &members, &configs, regions)?;
            stage.space = stage.space.with_span(measures.span);
            let slots = stage.space.slots();
            if measures.curves.contains(&line_bytes) {
                stage.curve = measures.exact_curves().then(|| CurveStack::new(slots));
                stage.shards = measures.sampled.map(|rate| Shards::new(slots, rate));
            }
            stage.working_sets = measures.working_sets.then(|| WorkingSetCounter::new(slots));
            let caches = stage.models.iter_mut().flat_map(|(_, caches)| caches);
            caches.for_each(|cache| cache.pages = measures.page_bytes.map(PageSwitches::new));
            stage.misses = Misses::new(measures.page_bytes.is_some());
            Ok::<_, SimulationError>(stage)
        };
        Ok(Self {
            regions: regions.to_vec(),
            stages: by_line.into_iter().map(stage).collect::<Result<_, _>>()?,
            configs,
            asked,
            record_pages: measures.page_bytes.map(PageSwitches::new),
            results: measures.results.map(ResultTraffic::new),
            measures: measures.clone(),
            records: Records::new(chunk),
            marks: vec![],
            batch: 0,
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
            stage.run(&batch, !self.warm_up, &self.marks);
        }
        if let Some(pages) = &mut self.record_pages {
            batch.reads().for_each(|(region, offset, len)| {
                let first = self.regions[region].base + offset;
                pages.fetch(first, first + u64::from(len.max(1) - 1), !self.warm_up);
            });
        }
        self.records.clear();
        self.marks.clear();
    }

    /// From now on, what the first cache fetches is kept for [`take_fetched`](Self::take_fetched).
    pub(super) fn keep_fetched(&mut self) {
        for stage in &mut self.stages {
            stage.fetched = Some(vec![]);
            stage.misses = Misses::new(true);
        }
    }

    /// Simulates what is waiting and moves region and line number of each fetch to `fetched`.
    pub(super) fn take_fetched(&mut self, fetched: &mut Vec<(u16, u64)>) {
        self.flush();
        let kept = self.stages.iter_mut().filter_map(|stage| stage.fetched.as_mut());
        kept.for_each(|kept| fetched.append(kept));
    }

    /// Ends the simulation: one row for each configuration, in the order they were given.
    ///
    /// # Panics
    ///
    /// As an access may: see [`Simulation`].
    #[must_use]
    pub fn finish(self) -> Vec<Row> {
        self.findings().rows
    }

    /// Ends the simulation: all that it found.
    ///
    /// # Panics
    ///
    /// As an access may: see [`Simulation`].
    #[must_use]
    pub fn findings(mut self) -> Findings {
        self.flush();
        let mut records = RecordCounts::default();
        self.record_counts.iter().for_each(|counts| records.add(counts));
        let mut rows = vec![None; self.configs.len()];
        let (mut curves, mut sampled) = (BTreeMap::new(), BTreeMap::new());
        for stage in std::mem::take(&mut self.stages) {
            let line_bytes = stage.space.line_bytes();
            let (queries, accesses, blocks) = (self.queries, stage.accesses, self.blocks(line_bytes.into()));
            let trace = TraceCounts { line_bytes, queries, records, accesses, blocks };
            curves.extend(stage.curve.map(|curve| (line_bytes, curve.finish(trace))));
            sampled.extend(stage.shards.map(|shards| (line_bytes, shards.finish(trace))));
            let sets = stage.working_sets.map(|sets| Rc::new(sets.finish()));
            for (model, caches) in stage.models {
                let tallies = model.finish();
                for cache in caches {
                    let config = self.configs[cache.config];
                    let mut row = self.row(config, stage.accesses, records, &tallies[cache.tally]);
                    let pages = if config.policy() == Policy::None { &self.record_pages } else { &cache.pages };
                    row.more.page_switches = pages.as_ref().map(|pages| pages.switches);
                    row.more.working_sets = sets.clone();
                    rows[cache.config] = Some(row);
                }
            }
        }
        let mut rows: Vec<Row> = rows.into_iter().flatten().collect();
        let twins = rows.split_off(self.asked);
        if self.measures.split {
            let mut twins = twins.into_iter();
            for row in rows.iter_mut().filter(|row| row.config.policy() != Policy::None) {
                let twin = if row.config.full_lru_twin().is_some() { twins.next() } else { None };
                row.more.full_lru_fetches = Some(twin.map_or(row.fetches, |twin| twin.fetches));
            }
        }
        let lines = &self.measures.curves;
        Findings {
            rows,
            curves: lines.iter().filter_map(|line| curves.get(line).cloned()).collect(),
            sampled: lines.iter().filter_map(|line| sampled.get(line).cloned()).collect(),
            result_bytes: self.results.map(ResultTraffic::finish),
        }
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
            more: More::default(),
        }
    }
}

impl TraceSink for Simulation {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.batch = batch;
        if warm_up != self.warm_up {
            self.flush();
            self.warm_up = warm_up;
        }
    }

    fn search(&mut self, destinations: &[u32]) {
        if !self.warm_up {
            self.searches += 1;
            self.queries += destinations.len() as u64;
            if self.measures.working_sets {
                self.marks.push(Mark { at: self.records.len(), batch: self.batch });
            }
        }
        if let Some(results) = &mut self.results {
            results.search(self.batch, destinations, !self.warm_up);
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
            let (cache, only) = (configs[config], CacheOfModel::new(config, 0));
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
                .flat_map(|(tally, (_, configs))| configs.iter().map(move |&config| CacheOfModel::new(config, tally)));
            models.push((Box::new(LruStack::new(&space, regions.len(), &lines)), caches.collect()));
        }
        Ok(Self {
            space,
            chunk: LineChunk::default(),
            accesses: 0,
            models,
            misses: Misses::default(),
            curve: None,
            shards: None,
            working_sets: None,
            fetched: None,
        })
    }

    fn run(&mut self, batch: &Batch, counted: bool, marks: &[Mark]) {
        if let Some(sets) = &mut self.working_sets
            && counted
        {
            sets.run(&self.space, batch, marks);
        }
        let mut cursor = Cursor::default();
        while self.chunk.split(&self.space, batch, &mut cursor) {
            if counted {
                self.accesses += self.chunk.accesses();
            }
            for (model, caches) in &mut self.models {
                self.misses.clear();
                model.run(&self.space, &self.chunk, counted, &mut self.misses);
                follow(&self.space, &self.chunk, &self.misses, caches, self.fetched.as_mut(), counted);
            }
            if let Some(curve) = &mut self.curve {
                curve.run(self.space.slots(), &self.chunk, counted);
            }
            if let Some(shards) = &mut self.shards {
                shards.run(&self.chunk, counted);
            }
        }
    }
}

/// Follows the misses of a model's caches: the pages they are in, and the lines that its first cache fetches.
fn follow(
    space: &LineSpace,
    chunk: &LineChunk,
    misses: &Misses,
    caches: &mut [CacheOfModel],
    mut fetched: Option<&mut Vec<(u16, u64)>>,
    counted: bool,
) {
    let line_bytes = u64::from(space.line_bytes());
    for miss in misses.list() {
        let region = chunk.tag(miss.index as usize).region();
        let line = space.line(region, chunk.slots()[miss.index as usize]);
        for cache in caches.iter_mut().filter(|cache| cache.tally < miss.caches as usize) {
            if let Some(pages) = &mut cache.pages {
                pages.fetch(line * line_bytes, line * line_bytes + (line_bytes - 1), counted);
            }
        }
        let by_first = caches.iter().any(|cache| cache.config == 0 && cache.tally < miss.caches as usize);
        if let Some(fetched) = &mut fetched
            && by_first
        {
            fetched.push((region as u16, line));
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
