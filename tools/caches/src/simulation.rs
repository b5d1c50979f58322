//! All caches in one reading of a trace.

mod error;
mod line_group;
#[cfg(test)]
mod once_tests;
mod outcome;
#[cfg(test)]
mod places_tests;
#[cfg(test)]
mod tests;
mod twins;
#[cfg(test)]
mod twins_tests;

pub use error::SimulationError;

use std::collections::BTreeMap;

use pm_formats::trace::{Access, Region, TraceSink, Waits};

use crate::config::check_line;
use crate::findings::ResultTraffic;
use crate::lines::{AccessBuffer, CHUNK, PAGE_SHIFT, Places, SearchStart};
use crate::misses::{Banks, PageSwitches, Waiting};
use crate::{CacheConfig, CacheCounts, LaneSink, Measures, RecordCounts};
use error::check_regions;
use line_group::LineGroup;
pub(crate) use line_group::Moved;

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
    groups: Vec<LineGroup>,
    configs: Vec<CacheConfig>,
    /// How many of them are asked for; the others are twins.
    asked: usize,
    measures: Measures,
    /// Accesses not yet simulated, all of one kind of block.
    waiting: AccessBuffer,
    /// Where searches that count begin among them, if somebody wants to know.
    starts: Vec<SearchStart>,
    /// What they wait for themselves, if somebody wants to know.
    waits: Option<Waiting>,
    batch: u64,
    warm_up: bool,
    results: Option<ResultTraffic>,
    /// Pages of records fetched without a cache, if there is a row of none.
    record_pages: Option<PageSwitches>,
    record_banks: Option<Banks>,
    queries: u64,
    searches: u64,
    record_counts: Vec<RecordCounts>,
    /// If the trace is of all addresses: places of pages, by log2 of their bytes.
    places: BTreeMap<u32, Places>,
    /// Why nothing more is simulated.
    fault: Option<SimulationError>,
}

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
        Self::in_chunks(regions, configs, measures, CHUNK)
    }

    /// The same with so many accesses simulated at a time, from 1 to 2048. It changes no result: this is for tests that say
    /// so.
    ///
    /// # Errors
    ///
    /// As [`measuring`](Self::measuring).
    pub fn in_chunks(
        regions: &[Region],
        configs: &[CacheConfig],
        measures: &Measures,
        chunk: usize,
    ) -> Result<Self, SimulationError> {
        check_regions(regions)?;
        let asked = configs.len();
        let mut configs = configs.to_vec();
        if measures.split || measures.miss_by_miss {
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
        let group = |(line_bytes, members): (u32, Vec<usize>)| {
            LineGroup::new(line_bytes, &members, &configs, regions, measures)
        };
        let groups = by_line.into_iter().map(group).collect::<Result<Vec<LineGroup>, _>>()?;
        // Blocks are counted by the usual pages, whatever the lines.
        let shifts = groups.iter().map(|group| group.page_shift).chain([PAGE_SHIFT]);
        let of_addresses = regions.iter().any(Region::is_addresses);
        let uncached = configs.iter().any(|config| !config.keeps_lines());
        let places = shifts.filter(|_| of_addresses).map(|shift| (shift, Places::new(shift))).collect();
        Ok(Self {
            regions: regions.to_vec(),
            groups,
            configs,
            asked,
            record_pages: measures.page_bytes.filter(|_| uncached).map(PageSwitches::new),
            record_banks: measures.dram.filter(|_| uncached).map(Banks::new),
            results: measures.results.map(ResultTraffic::new),
            measures: measures.clone(),
            waiting: AccessBuffer::new(chunk.max(1)),
            starts: vec![],
            waits: measures.miss_chains.then(Waiting::default),
            batch: 0,
            warm_up: false,
            queries: 0,
            searches: 0,
            record_counts: vec![RecordCounts::default(); regions.len()],
            places,
            fault: None,
        })
    }

    /// Simulates what is waiting.
    #[inline(never)]
    fn flush(&mut self) {
        if self.fault.is_some() {
            self.waiting.clear();
        }
        let accesses = self.waiting.waiting();
        // Where all addresses are, places are found for no others.
        let within = !self.places.is_empty() || accesses.are_within(&self.regions);
        assert!(within, "the trace's reader let through an access outside of its region");
        if !self.warm_up {
            accesses.count(&mut self.record_counts);
        }
        if self.places.is_empty() {
            for group in &mut self.groups {
                group.run(&accesses, !self.warm_up, &self.starts, self.waits.as_ref());
            }
        }
        for (&shift, places) in &mut self.places {
            self.groups.iter_mut().filter(|group| group.page_shift == shift).for_each(|group| group.space.let_go());
            places.take(&accesses, self.measures.span);
            for group in self.groups.iter_mut().filter(|group| group.page_shift == shift) {
                group.space.extend(places.pages());
                match group.space.check() {
                    Ok(()) => group.run(&places.placed(&accesses), !self.warm_up, &[], None),
                    Err(error) => self.fault = Some(error),
                }
            }
        }
        if let Some(banks) = &mut self.record_banks {
            accesses.reads().for_each(|(region, offset, len)| {
                let first = self.regions[region].base + offset;
                banks.fetch(first, first + u64::from(len.max(1) - 1), !self.warm_up);
            });
        }
        if let Some(pages) = &mut self.record_pages {
            accesses.reads().for_each(|(region, offset, len)| {
                let first = self.regions[region].base + offset;
                pages.fetch(first, first + u64::from(len.max(1) - 1), !self.warm_up);
            });
        }
        self.waiting.clear();
        self.starts.clear();
        self.waits.iter_mut().for_each(Waiting::clear);
    }

    /// Whether all went well so far: only a trace of all addresses can turn out to have too many lines.
    ///
    /// # Errors
    ///
    /// If it has. What is found is then worthless.
    pub fn check(&self) -> Result<(), SimulationError> {
        self.fault.clone().map_or(Ok(()), Err)
    }

    /// From now on, what the first cache fetches is kept for [`take_fetched`](Self::take_fetched).
    pub(crate) fn keep_fetched(&mut self) {
        self.groups.iter_mut().for_each(LineGroup::keep_fetched);
    }

    /// The same, and of each the number of the access is kept for [`take_fetched_by`](Self::take_fetched_by); not of a trace of
    /// all addresses.
    pub(crate) fn keep_fetched_by(&mut self) {
        self.groups.iter_mut().for_each(LineGroup::keep_fetched_by);
    }

    /// As [`take_fetched`](Self::take_fetched), each with the number of the access that fetched it, from 1 on.
    pub(crate) fn take_fetched_by(&mut self) -> Vec<(u64, Moved)> {
        self.flush();
        let kept = |group: &mut LineGroup| {
            let Some(kept) = &mut group.fetched else { return vec![] };
            let by = kept.by.as_mut().map(std::mem::take).unwrap_or_default();
            by.into_iter().zip(std::mem::take(&mut kept.moves)).collect::<Vec<_>>()
        };
        self.groups.iter_mut().flat_map(kept).collect()
    }

    /// Simulates what is waiting and moves what was fetched and, if it is measured, written back to `fetched`.
    pub(crate) fn take_fetched(&mut self, fetched: &mut Vec<Moved>) {
        self.flush();
        let kept = self.groups.iter_mut().filter_map(|group| group.fetched.as_mut());
        kept.for_each(|kept| fetched.append(&mut kept.moves));
    }

    /// Ends the simulation: the counts of each cache, in the order they were given.
    ///
    /// # Panics
    ///
    /// As an access may: see [`Simulation`].
    #[must_use]
    pub fn finish(self) -> Vec<CacheCounts> {
        self.findings().caches
    }
}

impl LaneSink for Simulation {}

impl TraceSink for Simulation {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.batch = batch;
        if warm_up != self.warm_up {
            self.flush();
            self.warm_up = warm_up;
        }
    }

    fn search(&mut self, destinations: &[u32]) {
        // Nobody knows what a search is where nobody knows the addresses.
        if !self.warm_up && self.places.is_empty() {
            self.searches += 1;
            self.queries += destinations.len() as u64;
            if self.measures.working_sets {
                self.starts.push(SearchStart { at: self.waiting.len(), batch: self.batch });
            }
        }
        if let Some(waits) = &mut self.waits {
            waits.search(self.waiting.len());
        }
        if let Some(results) = &mut self.results {
            results.search(self.batch, destinations, !self.warm_up);
        }
    }

    fn waits(&mut self, waits: Waits) {
        if self.waits.is_some() && self.waiting.is_full() {
            self.flush();
        }
        if let Some(waiting) = &mut self.waits {
            waiting.say(self.waiting.len(), waits);
        }
    }

    #[inline]
    fn access(&mut self, access: Access) {
        if !self.waiting.push(&access) {
            self.flush();
            self.waiting.push(&access);
        }
    }

    // Said here so that it is compiled with the caches, as fast as they are, and not with whoever replays.
    fn accesses(&mut self, mut accesses: &[Access]) {
        while !accesses.is_empty() {
            if self.waiting.is_full() {
                self.flush();
            }
            accesses = &accesses[self.waiting.push_all(accesses)..];
        }
    }

    fn records(&mut self, region: u16, size: u32, mut records: &[u32]) {
        while !records.is_empty() {
            if self.waiting.is_full() {
                self.flush();
            }
            records = &records[self.waiting.push_records(region, size, records)..];
        }
    }
}
