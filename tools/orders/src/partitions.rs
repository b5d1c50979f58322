//! Partitions of the queries that each fit the on-chip store, so that what is spilled is written once and read once.
//!
//! Sample sort (Frazer and McKellar, *Samplesort*, JACM 17(3), 1970) along a curve through the scene: a partition is an
//! interval of keys, and the intervals' ends come from a sample of the queries that is cast before the picture.

use super::sample::{RAYS_OF_A_SAMPLE, Sample};
use super::{BURST_BUFFER, Costs, Store};
use pm_formats::vocabulary::measure;
use pm_formats::{Number, Query};

/// Standard deviations by which a partition may exceed what the sample foretells before it overflows.
const MARGIN: f64 = 3.0;

/// The partitions of one batch or image after the other, and what they cost.
#[derive(Default)]
pub struct Partitions {
    sample: Sample,
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

impl Partitions {
    /// No queries yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A query has come: it may belong to the sample, which does not depend on when.
    pub(super) fn sample(&mut self, query: &Query, key: u32) {
        self.sample.see(query, key);
    }

    /// All `n` have come: where the partitions end.
    pub(super) fn decide(&mut self, n: u64, store: Store) {
        let mut keys = self.sample.take();
        keys.sort_unstable();
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

    /// The first key of each partition.
    #[cfg(test)]
    pub(super) fn firsts(&self) -> Vec<u32> {
        self.parts.iter().map(|part| part.first).collect()
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
        costs.tell(measure::PARTITIONS, Number::Count(self.totals.partitions));
        costs.tell(measure::PARTITIONS_OVERFLOWING, Number::Count(self.totals.overflowing));
        costs.tell(measure::PREPASS_RAYS, Number::Count(self.totals.rays));
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
mod tests;
