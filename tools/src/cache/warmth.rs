//! Whether an LRU cache that began empty holds what it would hold had it run for ever.
//!
//! A set of LRU holds the lines of it last used, as many as it has ways. So what was before is forgotten, and the state
//! *exact*, once each set has seen as many distinct lines as it has ways, or all that there are for it. Until then a line
//! that a set sees for the first time is a miss that might have been a hit; all else is known.

use pm_formats::trace::{Access, Region};

use super::{CacheConfig, Policy, lines::LineSpace, records::Shape, set_associative::Sets};

/// Watches what a cache sees from when it is empty until its state is exact.
pub(super) struct Warmth {
    space: LineSpace,
    sets: Sets,
    /// By slot: the last start after which the line was seen.
    seen: Vec<u32>,
    /// Starts so far.
    starts: u32,
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
    /// For a cache under LRU, or none, over lines of `space`.
    pub(super) fn new(regions: &[Region], space: LineSpace, cache: &CacheConfig) -> Self {
        let sets = Sets::new(cache.sets().max(1), cache.index());
        let mut seen = vec![0; space.slots() as usize];
        let mut lines = vec![0u32; sets.number()];
        if cache.policy() != Policy::None {
            for (region, extent) in regions.iter().enumerate().filter(|(_, extent)| extent.size > 0) {
                let line_of = |offset| {
                    let byte = Access::read(region as u16, offset, 1);
                    space.ends(offset, Shape::new(&byte)).0
                };
                let (first, last) = (line_of(0), line_of(extent.size - 1));
                for slot in first..=last {
                    // Lines that two regions share are one.
                    if std::mem::replace(&mut seen[slot as usize], 1) == 0 {
                        lines[sets.of(space.line(region, slot))] += 1;
                    }
                }
            }
            seen.fill(0);
        }
        let ways = cache.lines() / sets.number() as u64;
        let wanted: Vec<u32> = lines.into_iter().map(|lines| u64::from(lines).min(ways) as u32).collect();
        let open_sets = wanted.iter().filter(|&&lines| lines > 0).count();
        Self { space, sets, seen, starts: 0, missing: vec![], wanted, open_sets, open: 0 }
    }

    /// The cache is empty.
    pub(super) fn start(&mut self) {
        self.starts = self.starts.checked_add(1).unwrap_or_else(|| {
            self.seen.fill(0);
            1
        });
        self.missing.clone_from(&self.wanted);
        self.open = self.open_sets;
    }

    /// Whether its state is exact.
    pub(super) fn is_exact(&self) -> bool {
        self.open == 0
    }

    /// It sees an access, which lies within its region. Returns how many of its lines are seen for the first time since the
    /// start by a set that is not yet filled: whether the cache would have them, had it run for ever, is not known.
    pub(super) fn see(&mut self, access: &Access) -> u64 {
        let (first, last) = self.space.ends(access.offset, Shape::new(access));
        let mut unknown = 0;
        for slot in first..=last {
            if std::mem::replace(&mut self.seen[slot as usize], self.starts) == self.starts {
                continue;
            }
            let missing = &mut self.missing[self.sets.of(self.space.line(access.region.into(), slot))];
            if *missing > 0 {
                *missing -= 1;
                unknown += 1;
                self.open -= usize::from(*missing == 0);
            }
        }
        unknown
    }
}
