//! Traces of windows: each simulated by itself, all together an estimate of what the whole stream costs.
//!
//! A window is a run of blocks of one batch. Its caches begin empty. What is counted begins where a cache's state is exact
//! ([`Warmth`]), so that each access that counts hits or misses as it does when the whole stream is simulated: where the
//! window has warm-up blocks, at their end, or the window counts as *inexact* and is left out; where it has none, at the
//! first search from which on the state is exact.

use pm_formats::trace::{Access, Region, TraceSink};
use thiserror::Error;

use super::{CacheConfig, Measures, Policy, Row, Simulation, SimulationError, lines::LineSpace, warmth::Warmth};
use crate::statistics::{Ratio, Spread};

/// Runs caches over a trace of windows that is replayed into it.
pub struct Windows {
    regions: Vec<Region>,
    measures: Measures,
    caches: Vec<Cache>,
    /// The batch of the window in hand.
    window: Option<u64>,
    /// Its block in hand is warm-up.
    warm_up: bool,
    /// It has such blocks.
    has_warm_up: bool,
    /// Queries of the window that are not warm-up.
    queries: u64,
    /// Windows that are over: batch and queries that are not warm-up.
    over: Vec<(u64, u64)>,
    /// Queries of all windows, warm-up included.
    simulated: u64,
}

/// One cache, in one window after the other.
struct Cache {
    config: CacheConfig,
    warmth: Warmth,
    simulation: Option<Simulation>,
    stage: Stage,
    /// What each window that is over counted.
    windows: Vec<Option<Counts>>,
}

/// How far a cache is in a window.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// Nothing counts yet.
    Warming,
    /// The state was exact when counting began.
    Measuring,
    /// The state was not exact when counting should have begun.
    Inexact,
}

/// What a cache costs in a window, from where its state is exact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counts {
    /// The counts of a row, `compulsory` left out: what is first touched in the whole stream, a window does not know.
    pub row: Row,
    /// Distinct lines of each search, added up, if that was asked for.
    pub search_lines: Option<u64>,
}

impl Counts {
    /// What a simulation of one cache counted.
    fn of(simulation: Simulation) -> Self {
        let mut row = simulation.finish().swap_remove(0);
        let search_lines = row.more.working_sets.take().map(|sets| sets.per_search.sum());
        Self { row, search_lines }
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
    /// Prepares to simulate `configs`, each on its own, on a trace of these regions. Of `measures`, page switches, working
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
        let cache = |&config: &CacheConfig| {
            if !matches!(config.policy(), Policy::Lru | Policy::None) {
                return Err(WindowError::Policy(config));
            }
            // Says whether the regions can be simulated.
            Simulation::measuring(regions, &[config], &measures)?;
            let space = LineSpace::new(regions, config.line_bytes()).with_span(measures.span);
            let warmth = Warmth::new(regions, space, &config);
            Ok(Cache { config, warmth, simulation: None, stage: Stage::Warming, windows: vec![] })
        };
        Ok(Self {
            regions: regions.to_vec(),
            caches: configs.iter().map(cache).collect::<Result<_, _>>()?,
            measures,
            window: None,
            warm_up: false,
            has_warm_up: false,
            queries: 0,
            over: vec![],
            simulated: 0,
        })
    }

    fn end_window(&mut self) {
        let Some(batch) = self.window.take() else { return };
        self.over.push((batch, self.queries));
        let nothing_to_measure = self.queries == 0;
        for cache in &mut self.caches {
            cache.end_window(nothing_to_measure);
        }
    }

    fn begin_window(&mut self, batch: u64) {
        self.window = Some(batch);
        self.has_warm_up = false;
        self.queries = 0;
        for cache in &mut self.caches {
            cache.begin_window(&self.regions, &self.measures, batch);
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
        let numbered = self.over.is_sorted_by(|a, b| a.0 < b.0) && self.over.last().is_none_or(|last| last.0 < number);
        let place = |i: usize| if numbered { self.over[i].0 as usize } else { i };
        let mut queries = vec![0; number as usize];
        (0..self.over.len()).for_each(|i| queries[place(i)] = self.over[i].1);
        let share = share.filter(|&share| share > 0.0 && share <= 1.0);
        let blocks = |line: u64| {
            let bytes: u128 = self.regions.iter().map(|region| u128::from(region.size)).sum();
            bytes.div_ceil(line.into()) as u64
        };
        let row = |cache: Cache| {
            let mut counts = vec![Some(cache.nothing(&self.regions, &self.measures)); number as usize];
            cache.windows.into_iter().enumerate().for_each(|(i, window)| counts[place(i)] = window);
            WindowedRow {
                config: cache.config,
                blocks: blocks(cache.config.line_bytes().into()),
                share,
                queries_simulated: self.simulated,
                queries: queries.clone(),
                counts,
            }
        };
        std::mem::take(&mut self.caches).into_iter().map(row).collect()
    }
}

impl Cache {
    /// The cache, empty.
    fn simulation(&self, regions: &[Region], measures: &Measures) -> Simulation {
        let simulation = Simulation::measuring(regions, &[self.config], measures);
        simulation.unwrap_or_else(|error| unreachable!("it could be simulated before: {error}"))
    }

    /// What a window without queries counts.
    fn nothing(&self, regions: &[Region], measures: &Measures) -> Counts {
        Counts::of(self.simulation(regions, measures))
    }

    fn begin_window(&mut self, regions: &[Region], measures: &Measures, batch: u64) {
        let mut simulation = self.simulation(regions, measures);
        simulation.block(batch, true);
        self.simulation = Some(simulation);
        self.stage = Stage::Warming;
        self.warmth.start();
    }

    fn end_window(&mut self, nothing_to_measure: bool) {
        let exact = self.stage == Stage::Measuring || nothing_to_measure;
        let simulation = self.simulation.take().filter(|_| exact);
        self.windows.push(simulation.map(Counts::of));
    }

    /// A search begins that is not warm-up.
    fn begin_search(&mut self, batch: u64, has_warm_up: bool) {
        if self.stage == Stage::Warming {
            if self.warmth.is_exact() {
                self.stage = Stage::Measuring;
                if let Some(simulation) = &mut self.simulation {
                    simulation.block(batch, false);
                }
            } else if has_warm_up {
                self.stage = Stage::Inexact;
            }
        }
    }
}

impl TraceSink for Windows {
    fn block(&mut self, batch: u64, warm_up: bool) {
        if self.window != Some(batch) {
            self.end_window();
            self.begin_window(batch);
        }
        self.warm_up = warm_up;
        self.has_warm_up |= warm_up;
    }

    fn search(&mut self, destinations: &[u32]) {
        let queries = destinations.len() as u64;
        self.simulated += queries;
        self.queries += if self.warm_up { 0 } else { queries };
        let batch = self.window.unwrap_or(0);
        for cache in &mut self.caches {
            if !self.warm_up {
                cache.begin_search(batch, self.has_warm_up);
            }
            if let Some(simulation) = &mut cache.simulation {
                simulation.search(destinations);
            }
        }
    }

    fn access(&mut self, access: Access) {
        for cache in &mut self.caches {
            match cache.stage {
                Stage::Inexact => continue,
                Stage::Warming => cache.warmth.see(&access),
                Stage::Measuring => {}
            }
            if let Some(simulation) = &mut cache.simulation {
                simulation.access(access);
            }
        }
    }
}

/// A number and half the width of its 95 % interval, which is not a number where it cannot be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The estimate; not a number if there is none.
    pub value: f64,
    /// Half the width of the interval around it.
    pub half_width: f64,
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
    /// Of each window, queries that are not warm-up.
    queries: Vec<u64>,
    /// Of each window, what counts; none of a window that is inexact.
    counts: Vec<Option<Counts>>,
}

impl WindowedRow {
    /// Windows chosen, those without any query among them.
    #[must_use]
    pub fn windows(&self) -> u64 {
        self.counts.len() as u64
    }

    /// Windows in which the state was never exact, or not when warm-up ended. No estimate has anything of them.
    #[must_use]
    pub fn windows_inexact(&self) -> u64 {
        self.counts.iter().filter(|counts| counts.is_none()).count() as u64
    }

    /// Queries that count.
    #[must_use]
    pub fn queries_measured(&self) -> u64 {
        self.counts.iter().flatten().map(|counts| counts.row.queries).sum()
    }

    /// The ratio of two counts, such as fetches to queries.
    #[must_use]
    pub fn ratio(&self, above: impl Fn(&Counts) -> u64, below: impl Fn(&Counts) -> u64) -> Ratio {
        let of_windows = |count: &dyn Fn(&Counts) -> u64| -> Vec<f64> {
            self.counts.iter().flatten().map(|counts| count(counts) as f64).collect()
        };
        Ratio::of(&of_windows(&above), &of_windows(&below))
    }

    /// A count for each query.
    #[must_use]
    pub fn per_query(&self, count: impl Fn(&Counts) -> u64) -> Interval {
        let ratio = self.ratio(count, |counts| counts.row.queries);
        Interval { value: ratio.value, half_width: ratio.spread.half_width() }
    }

    /// A count of the whole stream: a count for each query measured, times the queries there are; and these are estimated
    /// from all windows, those that are inexact too. Not a number where the share is not known.
    #[must_use]
    pub fn total(&self, count: impl Fn(&Counts) -> u64) -> Interval {
        let Some(share) = self.share else { return Interval { value: f64::NAN, half_width: f64::NAN } };
        let ratio = self.ratio(&count, |counts| counts.row.queries);
        let queries = self.queries.iter().sum::<u64>() as f64 / share;
        // What each window adds to the estimate, to first order.
        let (mean, scale) = (queries * share / self.windows() as f64, queries / ratio.weight);
        let adds = |(counts, &queries): (&Option<Counts>, &u64)| {
            let residual =
                counts.as_ref().map_or(0.0, |counts| count(counts) as f64 - ratio.value * counts.row.queries as f64);
            scale * residual + ratio.value * (queries as f64 - mean) / share
        };
        let added: Vec<f64> = self.counts.iter().zip(&self.queries).map(adds).collect();
        Interval { value: ratio.value * queries, half_width: Spread::of_sum(&added).half_width() }
    }

    /// Queries of the whole stream.
    #[must_use]
    pub fn total_queries(&self) -> Interval {
        self.total(|counts| counts.row.queries)
    }
}
