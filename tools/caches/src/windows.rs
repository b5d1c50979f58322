//! Traces of windows: each simulated by itself, all together an estimate of what the whole stream costs.
//!
//! A window is a run of blocks of one batch, those of warm-up first. Its caches begin empty. Once a cache's state is exact
//! ([`Warmth`]), each access hits or misses as it does when the whole stream is simulated. Where that is so when warm-up
//! ends, the window is exact. Where it is not, the window must not be left out, since it is the searches that lie close
//! together and fetch little that do not fill a cache, and without them the estimate is too high. Nor may it count as if it
//! were exact. But the truth lies between two bounds, since lines that a set sees for the first time before it is filled are
//! all that is not known: half of these are counted, and the interval is as much wider.

use std::collections::BTreeSet;

use pm_formats::trace::{Access, Region, TraceSink};
use thiserror::Error;

use super::{CacheConfig, Measures, Policy, Row, Simulation, SimulationError, warmth::Warmth};
use pm_sampling::Ratio;

/// Runs caches over a trace of windows that is replayed into it.
pub struct Windows {
    regions: Vec<Region>,
    measures: Measures,
    caches: Vec<Cache>,
    /// One for each line size.
    warmths: Vec<Warmth>,
    /// All caches, in the window in hand.
    simulation: Simulation,
    /// The batch of the window in hand.
    window: Option<u64>,
    /// Its block in hand is warm-up.
    warm_up: bool,
    /// What counts has begun in the window in hand.
    measuring: bool,
    /// Batches of the windows that are over.
    over: Vec<u64>,
    /// Queries of all windows, warm-up included.
    simulated: u64,
}

/// One cache, in one window after the other.
struct Cache {
    config: CacheConfig,
    /// The state was exact when warm-up ended in the window in hand. Where nothing is measured, nothing is inexact.
    exact: bool,
    /// Of the window in hand, line accesses of each region that may be hits but are counted as misses.
    unknown: Vec<u64>,
    windows: Vec<Counts>,
}

/// What a cache costs in a window.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counts {
    /// The counts of a row, as if the cache were empty when the window begins. `compulsory` says nothing: what is first
    /// touched in the whole stream a window does not know.
    pub row: Row,
    /// Fetches of each region of which it is not known whether they are any.
    pub unknown: Vec<u64>,
    /// The state was exact when warm-up ended.
    pub exact: bool,
    /// Distinct lines of each search, added up, if that was asked for.
    pub search_lines: Option<u64>,
}

impl Counts {
    /// What a simulation counted of a cache.
    fn of(mut row: Row, unknown: Vec<u64>, exact: bool) -> Self {
        let search_lines = row.more.working_sets.take().map(|sets| sets.per_search.sum());
        Self { row, unknown, exact, search_lines }
    }

    /// Fetches of all regions of which it is not known whether they are any.
    #[must_use]
    pub fn unknown_fetches(&self) -> u64 {
        self.unknown.iter().sum()
    }
}

/// Why windows cannot be simulated.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum WindowError {
    /// A policy that has no exact state that is known.
    #[error(
        "{0}: only under LRU is it known when a cache that began empty holds what it would hold in the whole stream; \
         choose lru or none, or simulate a trace that is not sampled in windows"
    )]
    Policy(CacheConfig),
    /// No such simulation.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

impl Windows {
    /// Prepares to simulate `configs` on a trace of these regions. Of `measures`, page switches, working
    /// sets of searches and the rule for records that span lines are heeded.
    ///
    /// # Errors
    ///
    /// If a cache is neither under LRU nor none, and as [`Simulation::measuring`].
    pub fn new(regions: &[Region], configs: &[CacheConfig], measures: &Measures) -> Result<Self, WindowError> {
        let measures = Measures {
            page_bytes: measures.page_bytes,
            working_sets: measures.working_sets,
            span: measures.span,
            ..Measures::default()
        };
        if let Some(&other) = configs.iter().find(|config| !matches!(config.policy(), Policy::Lru | Policy::None)) {
            return Err(WindowError::Policy(other));
        }
        let cache =
            |&config: &CacheConfig| Cache { config, exact: true, unknown: vec![0; regions.len()], windows: vec![] };
        let line_sizes: BTreeSet<u32> = configs.iter().map(CacheConfig::line_bytes).collect();
        // Which finds out whether the regions are too large.
        let simulation = Simulation::measuring(regions, configs, &measures)?;
        let warmth = |line_bytes| Warmth::new(regions, measures.span, line_bytes, configs);
        Ok(Self {
            regions: regions.to_vec(),
            simulation,
            caches: configs.iter().map(cache).collect(),
            warmths: line_sizes.into_iter().map(warmth).collect(),
            measures,
            window: None,
            warm_up: false,
            measuring: false,
            over: vec![],
            simulated: 0,
        })
    }

    /// Empty caches.
    fn empty(&self) -> Simulation {
        let configs: Vec<CacheConfig> = self.caches.iter().map(|cache| cache.config).collect();
        let empty = Simulation::measuring(&self.regions, &configs, &self.measures);
        empty.unwrap_or_else(|error| unreachable!("they could be simulated before: {error}"))
    }

    fn end_window(&mut self) {
        if let Some(batch) = self.window.take() {
            self.over.push(batch);
            let empty = self.empty();
            let rows = std::mem::replace(&mut self.simulation, empty).finish();
            for (cache, row) in self.caches.iter_mut().zip(rows) {
                let unknown = std::mem::replace(&mut cache.unknown, vec![0; self.regions.len()]);
                cache.windows.push(Counts::of(row, unknown, cache.exact));
            }
        }
    }

    fn begin_window(&mut self, batch: u64) {
        self.window = Some(batch);
        self.simulation.block(batch, true);
        self.measuring = false;
        self.warmths.iter_mut().for_each(Warmth::start);
        self.caches.iter_mut().for_each(|cache| cache.exact = true);
    }

    fn begin_to_measure(&mut self, batch: u64) {
        self.measuring = true;
        self.simulation.block(batch, false);
        for (cache, exact) in self.warmths.iter().flat_map(Warmth::exact) {
            self.caches[cache].exact = exact;
        }
    }

    /// Ends the simulation: a row for each cache, in the order they were given. `chosen` is how many windows the sample
    /// was to have, of which those without any query are not in the trace; `share` is the part of the stream that they
    /// measure.
    #[must_use]
    pub fn finish(mut self, chosen: Option<u64>, share: Option<f64>) -> Vec<WindowedRow> {
        self.end_window();
        let number = chosen.unwrap_or(0).max(self.over.len() as u64);
        // Where batches number the windows, those that are missing stood there and had nothing to ask.
        let numbered = self.over.is_sorted_by(|a, b| a < b) && self.over.last().is_none_or(|&last| last < number);
        let place = |i: usize| if numbered { self.over[i] as usize } else { i };
        let share = share.filter(|&share| share > 0.0 && share <= 1.0);
        let bytes: u128 = self.regions.iter().map(|region| u128::from(region.size)).sum();
        // What a window without queries counts.
        let nothing = self.simulation.finish();
        let row = |(cache, nothing): (Cache, Row)| {
            let nothing = Counts::of(nothing, vec![0; self.regions.len()], true);
            let mut counts = vec![nothing; number as usize];
            cache.windows.into_iter().enumerate().for_each(|(i, window)| counts[place(i)] = window);
            let blocks = bytes.div_ceil(cache.config.line_bytes().into()) as u64;
            WindowedRow { config: cache.config, blocks, share, queries_simulated: self.simulated, counts }
        };
        std::mem::take(&mut self.caches).into_iter().zip(nothing).map(row).collect()
    }
}

impl TraceSink for Windows {
    fn block(&mut self, batch: u64, warm_up: bool) {
        if self.window != Some(batch) {
            self.end_window();
            self.begin_window(batch);
        }
        self.warm_up = warm_up;
    }

    fn search(&mut self, destinations: &[u32]) {
        self.simulated += destinations.len() as u64;
        if !self.warm_up && !self.measuring {
            self.begin_to_measure(self.window.unwrap_or(0));
        }
        self.simulation.search(destinations);
    }

    fn access(&mut self, access: Access) {
        for warmth in self.warmths.iter_mut().filter(|warmth| !warmth.all_exact()) {
            warmth.see(&access, |cache| {
                self.caches[cache].unknown[usize::from(access.region)] += u64::from(self.measuring);
            });
        }
        self.simulation.access(access);
    }
}

/// What the windows of a sample tell of one cache.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowedRow {
    /// The cache, as it was simulated.
    pub config: CacheConfig,
    /// Blocks of memory: bytes of all regions over bytes of a line, rounded up. Known, not estimated.
    pub blocks: u64,
    /// The part of the stream that the windows measure, if that is known.
    pub share: Option<f64>,
    /// Queries simulated, warm-up included.
    pub queries_simulated: u64,
    /// What each window costs, in the order of the stream; those without any query are among them.
    pub counts: Vec<Counts>,
}

impl WindowedRow {
    /// Windows in which the state was not exact when warm-up ended.
    #[must_use]
    pub fn windows_inexact(&self) -> u64 {
        self.counts.iter().filter(|counts| !counts.exact).count() as u64
    }

    /// Queries that count.
    #[must_use]
    pub fn queries_measured(&self) -> u64 {
        self.counts.iter().map(|counts| counts.row.queries).sum()
    }

    /// The row that some of the windows, by their places, would have given.
    #[must_use]
    pub fn of_windows(&self, windows: impl IntoIterator<Item = usize>) -> Self {
        let counts = windows.into_iter().map(|window| self.counts[window].clone()).collect();
        Self { counts, share: None, ..Self { counts: vec![], ..*self } }
    }

    fn each(&self, number: impl Fn(&Counts) -> u64) -> Vec<f64> {
        self.counts.iter().map(|counts| number(counts) as f64).collect()
    }

    /// The ratio of two counts, such as reads to queries. Of the first, what `unknown` counts may as well be nothing.
    pub fn ratio(
        &self,
        count: impl Fn(&Counts) -> u64,
        unknown: impl Fn(&Counts) -> u64,
        below: impl Fn(&Counts) -> u64,
    ) -> Ratio {
        Ratio::between(&self.each(count), &self.each(unknown), &self.each(below))
    }

    /// Fetches for each query.
    #[must_use]
    pub fn fetches_per_query(&self) -> Ratio {
        self.ratio(|counts| counts.row.fetches, Counts::unknown_fetches, |counts| counts.row.queries)
    }

    /// A count of the whole stream: that of the windows over their share of it. Not a number where that is not known.
    pub fn total(&self, count: impl Fn(&Counts) -> u64, unknown: impl Fn(&Counts) -> u64) -> Ratio {
        Ratio::total(&self.each(count), &self.each(unknown), self.share.unwrap_or(f64::NAN))
    }
}
