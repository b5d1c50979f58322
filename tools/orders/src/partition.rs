//! Partitions of the queries that each fit the on-chip store, so that what is spilled is written once and read once.
//!
//! Sample sort (Frazer and McKellar, *Samplesort*, JACM 17(3), 1970) along a curve through the scene: a partition is an
//! interval of keys, and the intervals' ends come from a sample of the queries that is cast before the picture.

use super::cost::{BURST_BUFFER, Costs, Store};
use pm_formats::{Number, Query};
use pm_random::Random;
use std::collections::BinaryHeap;

/// One of so many queries is in the sample.
const ONE_OF: u64 = 64;
/// Most queries of a sample.
const MOST_SAMPLED: usize = 1 << 18;
/// The sample of a small picture is not smaller than this, if there are so many queries.
const LEAST_SAMPLED: usize = 1 << 12;
/// Rays for each query of the sample: an eye ray and a gather ray.
const RAYS_OF_A_SAMPLE: u64 = 2;
/// Standard deviations by which a partition may exceed what the sample foretells before it overflows.
const MARGIN: f64 = 3.0;

/// The partitions of one batch or image after the other, and what they cost.
#[derive(Default)]
pub struct Partition {
    /// The sample: queries of the least hashes, with their keys.
    sample: BinaryHeap<(u64, u32)>,
    seen: u64,
    parts: Vec<Part>,
    /// The partition that queries leave from now.
    now: usize,
    totals: Totals,
}

/// An interval of keys.
#[derive(Clone, Copy)]
struct Part {
    first: u32,
    queries: u64,
    /// Do all its queries have one key? Then they need no sorting and may be more than the store holds.
    one_key: Option<u32>,
    mixed: bool,
}

/// Over all batches.
#[derive(Default)]
struct Totals {
    partitions: u64,
    overflowing: u64,
    rays: u64,
}

impl Partition {
    /// No queries yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A query has come: it may belong to the sample, which does not depend on when.
    pub(super) fn sample(&mut self, query: &Query, key: u32) {
        self.seen += 1;
        let identity = [u64::from(query.flags), u64::from(query.pixel), u64::from(query.sample)];
        let hash = Random::new(&identity).next_u64();
        let most = usize::try_from(self.seen / ONE_OF).unwrap_or(MOST_SAMPLED).clamp(LEAST_SAMPLED, MOST_SAMPLED);
        if self.sample.len() < most || self.sample.peek().is_some_and(|&(greatest, _)| hash < greatest) {
            self.sample.push((hash, key));
            if self.sample.len() > most {
                self.sample.pop();
            }
        }
    }

    /// All `n` have come: where the partitions end.
    pub(super) fn decide(&mut self, n: u64, store: Store) {
        let mut keys: Vec<u32> = std::mem::take(&mut self.sample).into_iter().map(|(_, key)| key).collect();
        keys.sort_unstable();
        self.seen = 0;
        self.now = 0;
        self.parts.clear();
        self.parts.push(Part::from(0));
        if n <= store.room() {
            return;
        }
        self.totals.rays += keys.len() as u64 * RAYS_OF_A_SAMPLE;
        let parts = partitions(n, store.room(), keys.len() as u64);
        for part in 1..parts {
            let first = keys[(part * keys.len() as u64 / parts) as usize];
            let last = self.parts.last().map_or(0, |last| last.first);
            if last < first {
                self.parts.push(Part::from(first));
            } else if last == first && first < u32::MAX {
                // Many queries of one key: a partition of their own, however many.
                self.parts.push(Part::from(first + 1));
            }
        }
    }

    /// A query leaves, in the order of keys.
    pub(super) fn count(&mut self, key: u32) {
        while self.parts.get(self.now + 1).is_some_and(|next| next.first <= key) {
            self.now += 1;
        }
        let part = &mut self.parts[self.now];
        part.queries += 1;
        part.mixed |= *part.one_key.get_or_insert(key) != key;
    }

    /// All `n` have left, which the store could not hold.
    pub(super) fn charge(&mut self, n: u64, costs: &mut Costs) {
        let store = costs.store();
        let parts = self.parts.len() as u64;
        let overflowing = self.parts.iter().filter(|part| part.mixed && part.queries > store.room());
        let again: u64 = overflowing.clone().map(|part| store.spilled_by_sort(part.queries)).sum();
        self.totals.overflowing += overflowing.count() as u64;
        self.totals.partitions = self.totals.partitions.max(parts);
        // First the store is buffers, one for each partition; then it holds one partition at a time.
        let fullest = self.parts.iter().map(|part| part.queries.min(store.room())).max().unwrap_or(0);
        let on_chip = (fullest * store.record.bytes()).max(parts.min(store.fan()) * BURST_BUFFER);
        costs.group(n, n * store.passes_to_part(parts) + again, on_chip);
        costs.tell("partitions", Number::Count(self.totals.partitions));
        costs.tell("partitions_overflowing", Number::Count(self.totals.overflowing));
        costs.tell("prepass_rays", Number::Count(self.totals.rays));
    }
}

impl Part {
    const fn from(first: u32) -> Self {
        Self { first, queries: 0, one_key: None, mixed: false }
    }
}

/// How many partitions, so that those which the sample foretells to be full nearly all fit `room`: the number of queries
/// between two quantiles of a sample of m, p of them, has a standard deviation of sqrt(p / m) of its mean.
fn partitions(n: u64, room: u64, sample: u64) -> u64 {
    let least = n as f64 / room as f64;
    let margin = 1.0 + MARGIN * libm::sqrt(least / sample.max(1) as f64);
    (libm::ceil(least * margin) as u64).clamp(1, sample.max(1))
}

#[cfg(test)]
mod tests {
    use super::super::cost::Record;
    use super::*;
    use bytemuck::Zeroable as _;
    use pm_formats::vocabulary::measure;

    fn run(keys: &[u32], bytes: u64) -> Costs {
        let mut costs = Costs::new(Store { bytes, record: Record::Full });
        let mut partition = Partition::new();
        for (pixel, &key) in (0..).zip(keys) {
            partition.sample(&Query { pixel, ..Query::zeroed() }, key);
        }
        partition.decide(keys.len() as u64, costs.store());
        let mut sorted = keys.to_vec();
        sorted.sort_unstable();
        sorted.into_iter().for_each(|key| partition.count(key));
        partition.charge(keys.len() as u64, &mut costs);
        costs
    }

    fn measure(costs: &Costs, name: &str) -> f64 {
        costs.measures().into_iter().find(|(known, _)| known == name).map(|(_, number)| number.as_f64()).unwrap()
    }

    #[test]
    fn partitions_fit_and_all_is_written_once() {
        let mut random = Random::new(&[3]);
        // Crowded at one end, as queries are in corners.
        let keys: Vec<u32> = (0..300_000).map(|_| (random.unit() * random.unit() * 1e9) as u32).collect();
        let bytes = 128 << 10;
        let costs = run(&keys, bytes);
        assert!(measure(&costs, measure::ON_CHIP) <= bytes as f64);
        assert!(measure(&costs, "partitions") >= 300_000.0 * 44.0 / bytes as f64);
        assert!(measure(&costs, "partitions_overflowing") <= 2.0);
        let once = 300_000.0 * 44.0;
        assert!((once..1.05 * once).contains(&measure(&costs, measure::SPILLED_WRITTEN)));
        assert_eq!(measure(&costs, measure::SPILLED_WRITTEN), measure(&costs, measure::SPILLED_READ));
        assert_eq!(measure(&costs, "prepass_rays"), 2.0 * f64::from(300_000 / 64));
    }

    #[test]
    fn queries_of_one_key_need_no_sorting() {
        let costs = run(&[7; 50_000], 64 << 10);
        assert_eq!(measure(&costs, "partitions_overflowing"), 0.0);
        assert_eq!(measure(&costs, measure::SPILLED_WRITTEN), 50_000.0 * 44.0);
        // And in a crowd, the others are sorted as ever.
        let crowded: Vec<u32> = (0..50_000).map(|i| if i % 2 == 0 { 1 << 20 } else { i * 40 }).collect();
        assert!(measure(&run(&crowded, 64 << 10), "spilled_written") < 1.3 * 50_000.0 * 44.0);
    }

    #[test]
    fn a_partition_that_overflows_pays_for_its_own_sort() {
        let mut costs = Costs::new(Store { bytes: 4400, record: Record::Full });
        let mut partition = Partition::new();
        // The sample foretells nothing of what comes.
        (0..8).for_each(|key| partition.sample(&Query { pixel: key, ..Query::zeroed() }, 1 << 29));
        partition.decide(1000, costs.store());
        (0..1000).for_each(|key| partition.count(key));
        partition.charge(1000, &mut costs);
        assert!(measure(&costs, measure::SPILLED_WRITTEN) >= 1.8 * 44_000.0);
        assert_eq!(measure(&costs, "partitions_overflowing"), 1.0);
        assert!(measure(&costs, measure::ON_CHIP) <= 4400.0);
    }
}
