//! Least frequently used, as one would write it down, and traces to try it on; nothing here is the library's.

use pm_formats::trace::{Access, AccessKind, Coding, Region, lay_out};
use pm_random::Random;

/// Regions, and accesses to them.
pub(crate) struct Trace {
    pub(crate) regions: Vec<Region>,
    pub(crate) accesses: Vec<Access>,
}

impl Trace {
    /// Two regions of 3,000 bytes. Of ten accesses seven are to where the one before was; one in four spans lines.
    pub(crate) fn random(seed: u64) -> Self {
        let mut random = Random::new(&[seed]);
        let mut below = |n: u64| random.next_u64() % n;
        let regions = lay_out(["a", "b"].map(|name| (name.to_owned(), 3000, 20, Coding::Records)));
        let (mut region, mut record) = (0, 0);
        let access = |_| {
            if below(10) >= 7 {
                (region, record) = (below(2) as u16, (record + below(40)) % 150);
            }
            let kind = if below(10) == 0 { AccessKind::ReadModifyWrite } else { AccessKind::Read };
            Access { kind, ..Access::read(region, record * 20, 20) }
        };
        Self { regions, accesses: (0..400).map(access).collect() }
    }

    /// Numbers of the lines accessed.
    pub(crate) fn line_accesses(&self, line: u64) -> Vec<u64> {
        let lines = |access: &Access| {
            let first = self.regions[usize::from(access.region)].base + access.offset;
            first / line..=(first + u64::from(access.len) - 1) / line
        };
        self.accesses.iter().flat_map(lines).collect()
    }
}

/// A line, how often it was used, and when last.
struct Held {
    line: u64,
    uses: u64,
    last: usize,
}

/// Sets as lists.
pub(crate) struct Naive {
    sets: Vec<Vec<Held>>,
    ways: u64,
}

impl Naive {
    pub(crate) fn new(sets: u64, ways: u64) -> Self {
        Self { sets: (0..sets).map(|_| vec![]).collect(), ways }
    }

    /// Of accesses to these lines, one after another, those that miss.
    pub(crate) fn misses(mut self, lines: &[u64]) -> u64 {
        let mut misses = 0;
        for (now, &line) in lines.iter().enumerate() {
            let number = self.sets.len() as u64;
            let set = &mut self.sets[(line % number) as usize];
            if let Some(held) = set.iter_mut().find(|held| held.line == line) {
                (held.uses, held.last) = (held.uses + 1, now);
                continue;
            }
            misses += 1;
            if set.len() as u64 == self.ways {
                set.sort_by_key(|held| (held.uses, held.last));
                set.remove(0);
            }
            set.push(Held { line, uses: 1, last: now });
        }
        misses
    }
}
