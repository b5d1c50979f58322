//! Whether a cache that began empty holds what it would hold had it run for ever.
//!
//! Under LRU, a set holds the lines of it last used, as many as it has ways. So what was before is forgotten, and the state
//! *exact*, once each set has seen as many distinct lines as it has ways, or all that there are for it. Until then a line
//! that a set sees for the first time is a miss that might have been a hit; all else is known.

use pm_formats::trace::{Access, Region};

use crate::lines::{LineSpace, Shape};
use crate::models::Sets;
use crate::{CacheConfig, SpanRule};

/// Watches what caches of one line size see from when they are empty until the states of all are exact.
pub(super) struct Warmth {
    space: LineSpace,
    /// By slot: the last start after which the line was seen.
    seen: Vec<u32>,
    /// Starts so far.
    starts: u32,
    caches: Vec<Filling>,
    /// Caches whose state is not exact.
    open: usize,
}

/// How far a cache is filled.
struct Filling {
    /// Which of the simulation's caches it is.
    cache: usize,
    sets: Sets,
    /// Distinct lines each set has to see.
    wanted: Vec<u32>,
    /// Distinct lines each set has yet to see since the start.
    missing: Vec<u32>,
    /// Sets that have lines to see.
    open_sets: usize,
    /// Those of them that have not seen them since the start.
    open: usize,
}

impl Warmth {
    /// For those of `caches`, whose policies forget what was before, whose lines are of `line_bytes`.
    pub(super) fn new(regions: &[Region], span: SpanRule, line_bytes: u32, caches: &[CacheConfig]) -> Self {
        let space = LineSpace::new(regions, line_bytes).with_span(span);
        let mut seen = vec![0; space.slots() as usize];
        let mut lines = vec![];
        for (region, extent) in regions.iter().enumerate().filter(|(_, extent)| extent.size > 0) {
            let line_of = |offset| {
                let byte = Access::read(region as u16, offset, 1);
                space.ends(offset, Shape::new(&byte)).0
            };
            let (first, last) = (line_of(0), line_of(extent.size - 1));
            // Lines that two regions share are one.
            let own = (first..=last).filter(|&slot| std::mem::replace(&mut seen[slot as usize], 1) == 0);
            lines.extend(own.map(|slot| space.line(region, slot)));
        }
        seen.fill(0);
        let caches = caches.iter().enumerate().filter(|(_, cache)| cache.line_bytes() == line_bytes);
        let caches = caches.map(|(i, cache)| Filling::new(i, cache, &lines)).collect();
        Self { space, seen, starts: 0, caches, open: 0 }
    }

    /// The caches are empty.
    pub(super) fn start(&mut self) {
        self.starts = self.starts.checked_add(1).unwrap_or_else(|| {
            self.seen.fill(0);
            1
        });
        for cache in &mut self.caches {
            cache.missing.clone_from(&cache.wanted);
            cache.open = cache.open_sets;
        }
        self.open = self.caches.iter().filter(|cache| cache.open > 0).count();
    }

    /// Whether the states of all are exact.
    pub(super) fn all_exact(&self) -> bool {
        self.open == 0
    }

    /// The caches, and whether their states are exact.
    pub(super) fn exact(&self) -> impl Iterator<Item = (usize, bool)> {
        self.caches.iter().map(|cache| (cache.cache, cache.open == 0))
    }

    /// They see an access, which lies within its region. `unknown` is told each cache that sees a line for the first time
    /// since the start in a set that is not yet filled: whether it would have the line, had it run for ever, is not known.
    #[inline]
    pub(super) fn see(&mut self, access: &Access, mut unknown: impl FnMut(usize)) {
        let (first, last) = self.space.ends(access.offset, Shape::new(access));
        for slot in first..=last {
            if std::mem::replace(&mut self.seen[slot as usize], self.starts) == self.starts {
                continue;
            }
            let line = self.space.line(access.region.into(), slot);
            for cache in self.caches.iter_mut().filter(|cache| cache.open > 0) {
                let missing = &mut cache.missing[cache.sets.of(line)];
                if *missing > 0 {
                    *missing -= 1;
                    unknown(cache.cache);
                    cache.open -= usize::from(*missing == 0);
                    self.open -= usize::from(cache.open == 0);
                }
            }
        }
    }
}

impl Filling {
    /// Of a cache in a memory of these lines.
    fn new(index: usize, cache: &CacheConfig, lines: &[u64]) -> Self {
        let sets = Sets::new(cache.sets().max(1), cache.index());
        let mut wanted = vec![0u32; sets.number()];
        // None where there is no cache.
        let ways = cache.lines() / sets.number() as u64;
        for &line in lines {
            let wanted = &mut wanted[sets.of(line)];
            *wanted += u32::from(u64::from(*wanted) < ways);
        }
        let open_sets = wanted.iter().filter(|&&lines| lines > 0).count();
        Self { cache: index, sets, missing: vec![], wanted, open_sets, open: 0 }
    }
}
