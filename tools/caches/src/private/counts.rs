//! What private caches cost together.

use super::ownership::Ownership;
use crate::CacheCounts;

/// What private caches have in common.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PrivateCounts {
    /// How many there are.
    pub elements: u64,
    /// Distinct lines that more than one of them fetched.
    pub lines_shared: u64,
    /// Record accesses of the element that makes most, and of all.
    pub accesses: (u64, u64),
    /// Fetches of the cache that fetches most, and of all.
    pub fetches: (u64, u64),
    /// The cache behind them, if they share one.
    pub shared: Option<CacheCounts>,
}

impl PrivateCounts {
    /// The busiest element's accesses over the mean: how much longer it takes than if all had the same to do.
    #[must_use]
    pub fn access_imbalance(&self) -> f64 {
        self.over_mean(self.accesses)
    }

    /// The same of fetches.
    #[must_use]
    pub fn fetch_imbalance(&self) -> f64 {
        self.over_mean(self.fetches)
    }

    fn over_mean(&self, (most, sum): (u64, u64)) -> f64 {
        most as f64 * self.elements as f64 / sum as f64
    }
}

/// The counts of one configuration, of all elements together. `plain` is the whole trace without a cache.
pub(super) fn together(
    rows: &[&CacheCounts],
    plain: &CacheCounts,
    accesses: &[u64],
    ownership: &Ownership,
    shared: Option<&CacheCounts>,
) -> CacheCounts {
    let mut all = rows[0].clone();
    for row in &rows[1..] {
        all.queries += row.queries;
        all.searches += row.searches;
        all.records.add(&row.records);
        all.accesses += row.accesses;
        all.fetches += row.fetches;
        all.bytes_fetched += row.bytes_fetched;
        all.bytes_written_back += row.bytes_written_back;
        all.region_fetches.iter_mut().zip(&row.region_fetches).for_each(|(sum, more)| *sum += more);
        all.more.full_lru_fetches = all.more.full_lru_fetches.zip(row.more.full_lru_fetches).map(|(a, b)| a + b);
    }
    all.compulsory = plain.compulsory;
    let most_and_sum = |numbers: &mut dyn Iterator<Item = u64>| {
        numbers.fold((0, 0), |(most, sum): (u64, u64), number| (most.max(number), sum + number))
    };
    all.more.private = Some(Box::new(PrivateCounts {
        elements: rows.len() as u64,
        lines_shared: ownership.shared(),
        accesses: most_and_sum(&mut accesses.iter().copied()),
        fetches: most_and_sum(&mut rows.iter().map(|row| row.fetches)),
        shared: shared.cloned(),
    }));
    all
}
