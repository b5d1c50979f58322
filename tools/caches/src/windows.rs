//! Traces of windows: each simulated by itself, all together an estimate of what the whole stream costs.
//!
//! A window is a run of blocks of one batch, those of warm-up first. Its caches begin empty. Once a cache's state is exact
//! ([`Warmth`]), each access hits or misses as it does when the whole stream is simulated. Where that is so when warm-up
//! ends, the window is exact. Where it is not, the window must not be left out, since it is the searches that lie close
//! together and fetch little that do not fill a cache, and without them the estimate is too high. Nor may it count as if it
//! were exact. But the truth lies between two bounds, since lines that a set sees for the first time before it is filled are
//! all that is not known: half of these are counted, and the interval is as much wider.

mod counted_windows;
mod error;
#[cfg(test)]
mod tests;
mod warmth;
mod window_counts;
mod windowed_counts;

pub use counted_windows::CountedWindows;
pub use error::WindowError;
pub use window_counts::WindowCounts;
pub use windowed_counts::WindowedCounts;

use std::collections::BTreeSet;

use pm_formats::trace::{Access, Region, TraceSink};

use crate::{CacheConfig, CacheCounts, Measures, Simulation};
use warmth::Warmth;

/// Runs caches over a trace of windows that is replayed into it.
pub struct Windows {
    regions: Vec<Region>,
    measures: Measures,
    caches: Vec<CacheInWindows>,
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
struct CacheInWindows {
    config: CacheConfig,
    /// The state was exact when warm-up ended in the window in hand. Where nothing is measured, nothing is inexact.
    exact: bool,
    /// Of the window in hand, line accesses of each region that may be hits but are counted as misses.
    unknown: Vec<u64>,
    windows: Vec<WindowCounts>,
}

impl Windows {
    /// Prepares to simulate `configs` on a trace of these regions. Of `measures`, page switches, working
    /// sets of searches and the rule for records that span lines are heeded.
    ///
    /// # Errors
    ///
    /// If of a cache it is not known when its state is exact, and as [`Simulation::measuring`].
    pub fn new(regions: &[Region], configs: &[CacheConfig], measures: &Measures) -> Result<Self, WindowError> {
        let measures = Measures {
            page_bytes: measures.page_bytes,
            working_sets: measures.working_sets,
            span: measures.span,
            ..Measures::default()
        };
        if let Some(&other) = configs.iter().find(|config| !config.policy().entry().forgets_what_was_before()) {
            return Err(WindowError::Policy(other));
        }
        let cache = |&config: &CacheConfig| CacheInWindows {
            config,
            exact: true,
            unknown: vec![0; regions.len()],
            windows: vec![],
        };
        if regions.iter().any(Region::is_addresses) {
            return Err(WindowError::Addresses);
        }
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
            let counts = std::mem::replace(&mut self.simulation, empty).finish();
            for (cache, counts) in self.caches.iter_mut().zip(counts) {
                let unknown = std::mem::replace(&mut cache.unknown, vec![0; self.regions.len()]);
                cache.windows.push(WindowCounts::of(counts, unknown, cache.exact));
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

    /// Caches whose state is not exact see these.
    fn warm(&mut self, accesses: impl Iterator<Item = Access> + Clone) {
        for warmth in &mut self.warmths {
            for access in accesses.clone() {
                if warmth.all_exact() {
                    break;
                }
                warmth.see(&access, |cache| {
                    self.caches[cache].unknown[usize::from(access.region)] += u64::from(self.measuring);
                });
            }
        }
    }

    /// Ends the simulation: what the windows tell of each cache, in the order they were given. `chosen` is how many windows the sample
    /// was to have, of which those without any query are not in the trace; `share` is the part of the stream that they
    /// measure.
    #[must_use]
    pub fn finish(mut self, chosen: Option<u64>, share: Option<f64>) -> Vec<WindowedCounts> {
        self.end_window();
        let number = chosen.unwrap_or(0).max(self.over.len() as u64);
        // Where batches number the windows, those that are missing stood there and had nothing to ask.
        let numbered = self.over.is_sorted_by(|a, b| a < b) && self.over.last().is_none_or(|&last| last < number);
        let place = |i: usize| if numbered { self.over[i] as usize } else { i };
        let share = share.filter(|&share| share > 0.0 && share <= 1.0);
        let bytes: u128 = self.regions.iter().map(|region| u128::from(region.size)).sum();
        // What a window without queries counts.
        let nothing = self.simulation.finish();
        let told = |(cache, nothing): (CacheInWindows, CacheCounts)| {
            let nothing = WindowCounts::of(nothing, vec![0; self.regions.len()], true);
            let mut windows = vec![nothing; number as usize];
            cache.windows.into_iter().enumerate().for_each(|(i, window)| windows[place(i)] = window);
            let blocks = bytes.div_ceil(cache.config.line_bytes().into()) as u64;
            WindowedCounts { config: cache.config, blocks, share, queries_simulated: self.simulated, windows }
        };
        std::mem::take(&mut self.caches).into_iter().zip(nothing).map(told).collect()
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
        self.warm([access].into_iter());
        self.simulation.access(access);
    }

    fn accesses(&mut self, accesses: &[Access]) {
        self.warm(accesses.iter().copied());
        self.simulation.accesses(accesses);
    }

    fn records(&mut self, region: u16, size: u32, records: &[u32]) {
        self.warm(records.iter().map(|&record| Access::read(region, u64::from(record) * u64::from(size), size)));
        self.simulation.records(region, size, records);
    }
}
