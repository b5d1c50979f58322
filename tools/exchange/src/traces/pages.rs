//! Which pages of the address space a trace touches, and regions made of them.
//!
//! Whoever simulates a trace numbers the lines of its regions, so the regions must be few bytes; and it must see the true
//! addresses, for a cache of sets puts a line where its address says. So each run of touched pages is a region, at its own
//! address. Should there be more runs than regions can be told apart, the narrowest gaps are bridged.

use pm_formats::trace::{Coding, Region};
use std::collections::HashSet;

/// log2 of the bytes of a page, those that keep regions apart.
const SHIFT: u32 = 12;
/// Regions that an access can name.
const MOST_REGIONS: usize = 1 << 16;
/// Pages remembered as noted, by their low bits: most accesses need no look at the set.
const RECENT: usize = 1 << 10;

/// Pages touched.
pub(super) struct Pages {
    touched: HashSet<u64>,
    recent: Box<[u64; RECENT]>,
}

impl Pages {
    pub(super) fn new() -> Self {
        // No page has this number: they have 52 bits.
        Self { touched: HashSet::new(), recent: Box::new([u64::MAX; RECENT]) }
    }

    /// The bytes from `first` to `last` are touched.
    pub(super) fn touch(&mut self, first: u64, last: u64) {
        for page in first >> SHIFT..=last >> SHIFT {
            let recent = &mut self.recent[page as usize % RECENT];
            if *recent != page {
                *recent = page;
                self.touched.insert(page);
            }
        }
    }

    /// Regions in order of addresses that hold all that was touched.
    pub(super) fn regions(self, name: &str) -> Vec<Region> {
        self.at_most(name, MOST_REGIONS)
    }

    fn at_most(self, name: &str, most: usize) -> Vec<Region> {
        let mut pages: Vec<u64> = self.touched.into_iter().collect();
        pages.sort_unstable();
        // Gaps wider than this part regions; of those just as wide, the first `spare`.
        let mut gaps: Vec<u64> = pages.windows(2).map(|pair| pair[1] - pair[0]).filter(|&gap| gap > 1).collect();
        let (widest, mut spare) = if gaps.len() < most {
            (1, 0)
        } else {
            let kept = most - 1;
            gaps.sort_unstable_by(|a, b| b.cmp(a));
            let widest = gaps[kept];
            (widest, kept - gaps.partition_point(|&gap| gap > widest))
        };
        let mut runs: Vec<(u64, u64)> = vec![];
        for page in pages {
            if let Some((_, last)) = runs.last_mut() {
                let gap = page - *last;
                let parts = gap > widest || (gap == widest && spare > 0);
                spare -= usize::from(gap == widest && parts);
                if !parts {
                    *last = page;
                    continue;
                }
            }
            runs.push((page, page));
        }
        let region = |(first, last): (u64, u64)| Region {
            name: name.to_owned(),
            base: first << SHIFT,
            size: (last - first + 1) << SHIFT,
            record_size: 1,
            coding: Coding::Records,
        };
        runs.into_iter().map(region).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn spans(regions: &[Region]) -> Vec<(u64, u64)> {
        regions.iter().map(|region| (region.base >> SHIFT, region.size >> SHIFT)).collect()
    }

    #[test]
    fn runs_of_pages_are_regions_at_their_addresses() {
        let mut pages = Pages::new();
        for (first, last) in [(u64::MAX - 5, u64::MAX), (0, 0), (4095, 4096), (1 << 40, (1 << 40) + 9000)] {
            pages.touch(first, last);
        }
        assert_eq!(spans(&pages.regions("x")), [(0, 2), (1 << 28, 3), ((1 << 52) - 1, 1)]);
        assert_eq!(Pages::new().regions("x"), []);
    }

    proptest! {
        #[test]
        fn bridged_regions_hold_every_page_and_are_as_few_as_asked(
            touched in prop::collection::btree_set(0u64..300, 1..60), most in 1usize..20
        ) {
            let mut pages = Pages::new();
            touched.iter().for_each(|page| pages.touch(page << SHIFT, page << SHIFT));
            let spans = spans(&pages.at_most("x", most));
            let gaps = || touched.iter().zip(touched.iter().skip(1)).map(|(a, b)| b - a - 1).filter(|&gap| gap > 0);
            prop_assert_eq!(spans.len(), most.min(gaps().count() + 1));
            prop_assert!(touched.iter().all(|&page| spans.iter().any(|&(at, len)| at <= page && page < at + len)));
            // As many pages as the narrowest gaps have, and no more, are bridged.
            let mut gaps: Vec<u64> = gaps().collect();
            gaps.sort_unstable();
            let bridged: u64 = gaps[..(gaps.len() + 1 - spans.len())].iter().sum();
            prop_assert_eq!(spans.iter().map(|span| span.1).sum::<u64>(), touched.len() as u64 + bridged);
        }
    }
}
