//! Several processing elements with a cache each, in front of memory or of a cache that they share.
//!
//! Each element makes one access in its turn, in the order in which [`Lanes`](crate::Lanes) tells of them, whose lanes the elements
//! are. So what one element's cache fetches depends on its own searches alone, and the order of turns matters to the shared cache
//! and to nothing else.

mod counts;
mod ownership;
mod shared;
#[cfg(test)]
mod tests;

pub use counts::PrivateCounts;

use std::collections::BTreeMap;

use pm_formats::trace::{Access, Region, TraceSink};

use crate::{CacheConfig, CacheCounts, Findings, LaneSink, Measures, Simulation, SimulationError};
use counts::together;
use ownership::Ownership;
use shared::Shared;

/// Runs private caches over a trace that lanes replay into it, a lane an element.
///
/// ```
/// use pm_formats::trace::{Access, Coding, TraceSink, lay_out};
/// use pm_caches::{LaneSource, Lanes, Measures, PrivateCaches};
///
/// let regions = lay_out([("photons".to_owned(), 1000, 20, Coding::Records)]);
/// let caches = ["128K,full,128,lru".parse().unwrap()];
/// let private = PrivateCaches::new(&regions, &caches, &Measures::default(), 2, None).unwrap();
/// let mut lanes = Lanes::new(private, 2, LaneSource::Stream).unwrap();
/// lanes.block(0, false);
/// for photon in [0, 1] {
///     lanes.search(&[7]);
///     lanes.access(Access::read(0, photon * 20, 20)); // of one line, by two elements
///     lanes.search_end();
/// }
/// let counts = &lanes.finish().unwrap().findings().caches[0];
/// assert_eq!((counts.fetches, counts.compulsory), (2, 1));
/// assert_eq!(counts.more.private.as_ref().unwrap().lines_shared, 1);
/// ```
pub struct PrivateCaches {
    elements: Vec<Element>,
    /// The element whose turn it is.
    at: usize,
    /// The block of what comes next.
    origin: (u64, bool),
    /// The trace without caches: what all elements do together.
    whole: Simulation,
    /// By bytes of a line.
    ownership: BTreeMap<u32, Ownership>,
    shared: Option<Shared>,
}

/// A processing element.
struct Element {
    caches: Simulation,
    /// The block it was told of last.
    told: Option<(u64, bool)>,
    /// Accesses that count.
    accesses: u64,
}

impl PrivateCaches {
    /// So many elements, at least one, each with a cache of every configuration, one row for each. Behind the first one there may
    /// be a cache that all elements share.
    ///
    /// Page switches, rows of DRAM and working sets are those of one element, and found only if there is no other.
    ///
    /// # Errors
    /// As [`Simulation::measuring`]; [`SimulationError::NoLines`] if a cache is to be shared behind none.
    pub fn new(
        regions: &[Region],
        configs: &[CacheConfig],
        measures: &Measures,
        elements: u16,
        shared: Option<CacheConfig>,
    ) -> Result<Self, SimulationError> {
        let elements = usize::from(elements.max(1));
        let alone = elements == 1;
        let own = Measures {
            split: measures.split,
            span: measures.span,
            page_bytes: measures.page_bytes.filter(|_| alone),
            dram: measures.dram.filter(|_| alone),
            working_sets: measures.working_sets && alone,
            ..Measures::default()
        };
        let lines: Vec<u32> = configs.iter().map(CacheConfig::line_bytes).collect();
        let plain = lines.iter().map(|&line| CacheConfig::none(line).expect("the line of a cache"));
        let of_whole = Measures { results: measures.results, span: measures.span, ..Measures::default() };
        let element = |_| {
            let mut caches = Simulation::measuring(regions, configs, &own)?;
            if shared.is_some() {
                caches.keep_fetched_by();
            }
            Ok(Element { caches, told: None, accesses: 0 })
        };
        let shared = match (shared, configs.first()) {
            (Some(shared), Some(first)) if first.keeps_lines() => {
                Some(Shared::new(regions, first.line_bytes(), shared, elements)?)
            }
            (Some(_), Some(&first)) => return Err(SimulationError::NoLines(first)),
            _ => None,
        };
        Ok(Self {
            elements: (0..elements).map(element).collect::<Result<_, SimulationError>>()?,
            at: 0,
            origin: (0, false),
            whole: Simulation::measuring(regions, &plain.collect::<Vec<_>>(), &of_whole)?,
            ownership: lines.iter().map(|&line| (line, Ownership::new(regions, line, measures.span))).collect(),
            shared,
        })
    }

    /// The element whose turn it is, told of the block.
    fn element(&mut self) -> &mut Element {
        let element = &mut self.elements[self.at];
        if element.told != Some(self.origin) {
            element.told = Some(self.origin);
            element.caches.block(self.origin.0, self.origin.1);
        }
        element
    }

    /// What came of it: the counts of all elements together, for each configuration.
    #[must_use]
    pub fn findings(mut self) -> Findings {
        let shared =
            self.shared.map(|shared| shared.finish(self.elements.iter_mut().map(|element| &mut element.caches)));
        let accesses: Vec<u64> = self.elements.iter().map(|element| element.accesses).collect();
        let whole = self.whole.findings();
        let found: Vec<Vec<CacheCounts>> = self.elements.into_iter().map(|element| element.caches.finish()).collect();
        let row = |(at, plain): (usize, &CacheCounts)| {
            let rows: Vec<&CacheCounts> = found.iter().map(|rows| &rows[at]).collect();
            let ownership = &self.ownership[&plain.config.line_bytes()];
            together(&rows, plain, &accesses, ownership, shared.as_ref().filter(|_| at == 0))
        };
        Findings {
            caches: whole.caches.iter().enumerate().map(row).collect(),
            curves: vec![],
            sampled: vec![],
            result_bytes: whole.result_bytes,
        }
    }
}

impl LaneSink for PrivateCaches {
    fn lane(&mut self, lane: usize) {
        self.at = lane;
    }
}

impl TraceSink for PrivateCaches {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.origin = (batch, warm_up);
        self.whole.block(batch, warm_up);
    }

    fn search(&mut self, destinations: &[u32]) {
        self.whole.search(destinations);
        self.element().caches.search(destinations);
    }

    fn access(&mut self, access: Access) {
        let (at, counted) = (self.at, !self.origin.1);
        self.whole.access(access);
        self.ownership.values_mut().for_each(|lines| lines.touch(at, &access, counted));
        let element = self.element();
        element.accesses += u64::from(counted);
        element.caches.access(access);
        if let Some(shared) = &mut self.shared
            && shared.turn(at, counted)
        {
            shared.pass_on(self.elements.iter_mut().map(|element| &mut element.caches));
        }
    }

    fn search_end(&mut self) {
        self.whole.search_end();
        self.element().caches.search_end();
    }
}
