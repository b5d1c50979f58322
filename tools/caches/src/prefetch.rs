//! Prefetching: a miss brings in lines that nobody has asked for yet.
//!
//! On a miss (Smith, *Cache Memories*, ACM Computing Surveys 14(3), 1982, section 2.1, tells when else one could), so that lines that are
//! all used cost no more than they did. What comes in is as recent as can be, and the line that was missed more recent
//! still; lines that are there already stay as recent as they were.
//!
//! A treelet is what Chou and others (*Treelet Prefetching for Ray Tracing*, MICRO 2023) prefetch: a part of a tree that lies in one
//! piece. Here it is a block of consecutive lines, counted from where a region begins, so that it is the layout that makes it a
//! part of a tree, or does not.

mod counts;
mod prefetcher;
mod recency;
#[cfg(test)]
mod tests;

pub use counts::PrefetchCounts;
pub use prefetcher::{PrefetchError, Prefetcher};

use pm_formats::trace::{Access, AccessKind, Region, TraceSink};

use crate::lines::{LineSpace, Shape};
use crate::{AskedCounts, CacheConfig, CacheCounts, Findings, Measures, Simulation, SpanRule};
use recency::Recency;

/// Runs fully associative LRU caches with a prefetcher over a trace, each beside the same without.
///
/// ```
/// use pm_formats::trace::{Access, Coding, TraceSink, lay_out};
/// use pm_caches::{Measures, Prefetching};
///
/// let regions = lay_out([("photons".to_owned(), 1024, 128, Coding::Records)]);
/// let caches = ["1K,full,128,lru".parse().unwrap()];
/// let treelets = "treelet:512".parse().unwrap();
/// let mut prefetching = Prefetching::new(&regions, &caches, &Measures::default(), treelets).unwrap();
/// prefetching.block(0, false);
/// prefetching.search(&[7]);
/// for line in [1, 2, 5] {
///     prefetching.access(Access::read(0, line * 128, 128));
/// }
/// prefetching.search_end();
/// let counts = &prefetching.findings().caches[0];
/// let prefetch = counts.more.prefetch.as_ref().unwrap();
/// assert_eq!((counts.fetches, prefetch.fetches_without, prefetch.prefetched, prefetch.used), (2, 3, 6, 1));
/// ```
pub struct Prefetching {
    /// The trace, and the caches without.
    plain: Simulation,
    caches: Vec<Cache>,
    prefetcher: Prefetcher,
    /// Does what comes next count?
    counted: bool,
}

/// A cache with a prefetcher.
struct Cache {
    space: LineSpace,
    held: Recency,
    /// First and last slot of each region.
    ends: Vec<(u32, u32)>,
    fetches: Vec<u64>,
    prefetched: u64,
    used: u64,
    /// Lines that turned dirty where they lay.
    written: u64,
}

impl Prefetching {
    /// These caches, of the prefetcher each.
    ///
    /// # Errors
    /// If one is not fully associative LRU, or does not hold what one miss brings in; if nothing more is brought in than
    /// a line; or as [`Simulation::measuring`].
    pub fn new(
        regions: &[Region],
        configs: &[CacheConfig],
        measures: &Measures,
        prefetcher: Prefetcher,
    ) -> Result<Self, PrefetchError> {
        if regions.iter().any(Region::is_addresses) {
            return Err(PrefetchError::NoRegions);
        }
        if measures.span == SpanRule::Once {
            return Err(PrefetchError::Records);
        }
        configs.iter().try_for_each(|config| prefetcher.check(config))?;
        // Which pages and rows are met depends on what is prefetched.
        let own = Measures { page_bytes: None, ..measures.clone() };
        let plain = Simulation::measuring(regions, configs, &own)?;
        let caches = configs.iter().map(|config| Cache::new(regions, config, measures.span)).collect();
        Ok(Self { plain, caches, prefetcher, counted: true })
    }

    /// What came of it: fetches are misses that are left, bytes fetched those of what was prefetched as well.
    #[must_use]
    pub fn findings(self) -> Findings {
        let mut found = self.plain.findings();
        for (counts, cache) in found.caches.iter_mut().zip(self.caches) {
            cache.tell(self.prefetcher, counts);
        }
        found
    }
}

impl TraceSink for Prefetching {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.counted = !warm_up;
        self.plain.block(batch, warm_up);
    }

    fn search(&mut self, destinations: &[u32]) {
        self.plain.search(destinations);
    }

    fn access(&mut self, access: Access) {
        self.plain.access(access);
        self.caches.iter_mut().for_each(|cache| cache.access(&access, self.prefetcher, self.counted));
    }

    fn search_end(&mut self) {
        self.plain.search_end();
    }
}

impl Cache {
    fn new(regions: &[Region], config: &CacheConfig, span: SpanRule) -> Self {
        let space = LineSpace::new(regions, config.line_bytes()).with_span(span);
        let slot = |region: usize, offset| space.ends(offset, Shape::new(&Access::read(region as u16, offset, 1))).0;
        let ends = (0..regions.len()).map(|it| (slot(it, 0), slot(it, regions[it].size.saturating_sub(1)))).collect();
        let held = Recency::new(space.slots() as usize, config.lines());
        let fetches = vec![0; regions.len()];
        Self { space, held, ends, fetches, prefetched: 0, used: 0, written: 0 }
    }

    fn access(&mut self, access: &Access, prefetcher: Prefetcher, counted: bool) {
        let (first, last) = self.space.ends(access.offset, Shape::new(access));
        for slot in first..=last {
            match self.held.state(slot) {
                None => {
                    self.fetches[usize::from(access.region)] += u64::from(counted);
                    let ends = self.ends[usize::from(access.region)];
                    for other in prefetcher.lines(slot, ends, self.space.line_bytes()) {
                        if other != slot && self.held.state(other).is_none() {
                            self.held.bring_in(other, counted);
                            self.prefetched += u64::from(counted);
                        }
                    }
                    self.held.bring_in(slot, false);
                }
                Some(state) => {
                    self.used += u64::from(state.awaited && counted);
                    self.held.use_again(slot);
                }
            }
            if counted && access.kind != AccessKind::Read {
                self.written += u64::from(self.held.soil(slot));
            }
        }
    }

    /// Puts what was counted in the place of what is counted without.
    fn tell(self, prefetcher: Prefetcher, counts: &mut CacheCounts) {
        let line = u64::from(self.space.line_bytes());
        let fetches_without = counts.fetches;
        counts.region_fetches = self.fetches;
        counts.fetches = counts.region_fetches.iter().sum();
        counts.bytes_fetched = (counts.fetches + self.prefetched) * line;
        counts.bytes_written_back = self.written * line;
        let (prefetched, used) = (self.prefetched, self.used);
        let prefetch = PrefetchCounts { prefetcher, fetches: counts.fetches, fetches_without, prefetched, used };
        // What is said of capacity and of sets is said of caches without.
        let working_sets = counts.more.working_sets.take();
        counts.more = AskedCounts { working_sets, prefetch: Some(prefetch), ..AskedCounts::default() };
    }
}
