//! What lookups were like: how far they reached, how much they read.

use pm_formats::Query;
use pm_formats::trace::Region;
use pm_maps::{Nearest, SearchReads, offset_of};
use pm_random::mix;
use std::ops::AddAssign;

/// Queries that are kept, of all there are.
const SAMPLES: usize = 1000;

/// Bits that are dropped from a distance for the table of quantiles: ten of its fraction stay, a part in a thousand.
const DROPPED: u32 = 13;

/// Describes lookups; the same in whatever order they are added, but for the rounding of the mean distance.
#[derive(Clone, Debug)]
pub struct Lookups {
    line: u32,
    regions: Vec<(u64, u32)>,
    padding: Option<u32>,
    /// Lookups.
    pub queries: u64,
    /// Records read.
    pub reads: u64,
    /// Photons whose distance was computed.
    pub photons_examined: u64,
    /// Lines read, each once a lookup.
    pub lines: u64,
    /// Lookups that found k photons.
    pub full: u64,
    distance: f64,
    /// Distances of the k-th photons, sorted.
    quantiles: std::collections::BTreeMap<u32, u64>,
    /// The queries whose hashes are least, each after its hash.
    sample: Vec<(u64, Query)>,
    touched: Vec<u64>,
}

impl Lookups {
    /// Of a map of these regions, in lines of so many bytes.
    #[must_use]
    pub fn new(line: u32, regions: &[Region], padding: Option<u32>) -> Self {
        Self {
            line,
            regions: regions.iter().map(|region| (region.base, region.record_size)).collect(),
            padding,
            queries: 0,
            reads: 0,
            photons_examined: 0,
            lines: 0,
            full: 0,
            distance: 0.0,
            quantiles: std::collections::BTreeMap::new(),
            sample: vec![],
            touched: vec![],
        }
    }

    /// Adds a lookup.
    pub fn add(&mut self, query: &Query, found: &Nearest, reads: &SearchReads) {
        self.queries += 1;
        self.reads += reads.len() as u64;
        self.photons_examined += reads.photons_examined();
        let line = u64::from(self.line);
        self.touched.clear();
        for (region, records) in reads.runs() {
            let (base, size) = self.regions[usize::from(region)];
            for &record in records {
                let from = base + offset_of(record, size, self.padding);
                self.touched.extend(from / line..=(from + u64::from(size) - 1) / line);
            }
        }
        self.touched.sort_unstable();
        self.touched.dedup();
        self.lines += self.touched.len() as u64;
        if let Some((distance, _)) = found.farthest().filter(|_| found.is_full()) {
            self.full += 1;
            let distance = distance.sqrt();
            self.distance += f64::from(distance);
            *self.quantiles.entry(distance.to_bits() >> DROPPED).or_default() += 1;
        }
        let hash = mix(u64::from(query.pixel) << 32 | u64::from(query.sample));
        self.sample.push((hash, *query));
        if self.sample.len() >= 8 * SAMPLES {
            self.cut_sample();
        }
    }

    fn cut_sample(&mut self) {
        let bytes = bytemuck::bytes_of::<Query>;
        // Queries of one name are a fault of the stream, which is no reason to choose among them by chance.
        self.sample.sort_unstable_by(|(a, one), (b, other)| a.cmp(b).then_with(|| bytes(one).cmp(bytes(other))));
        self.sample.truncate(SAMPLES);
    }

    /// Mean distance of the k-th photon, in scene units, over the lookups that found k.
    #[must_use]
    pub fn mean_distance(&self) -> f64 {
        self.distance / self.full as f64
    }

    /// A quantile of the distance of the k-th photon, to a part in a thousand; NaN if no lookup found k.
    #[must_use]
    pub fn distance_quantile(&self, share: f64) -> f64 {
        let mut rest = (share * self.full as f64) as u64;
        for (&bits, &count) in &self.quantiles {
            if rest < count || rest == count && share >= 1.0 {
                return f64::from(f32::from_bits(bits << DROPPED));
            }
            rest -= count;
        }
        f64::NAN
    }

    /// Up to 1,000 queries, chosen by a hash of what they are for: the same in every order.
    #[must_use]
    pub fn sample(&mut self) -> Vec<Query> {
        self.cut_sample();
        self.sample.iter().map(|&(_, query)| query).collect()
    }
}

impl AddAssign for Lookups {
    fn add_assign(&mut self, other: Self) {
        self.queries += other.queries;
        self.reads += other.reads;
        self.photons_examined += other.photons_examined;
        self.lines += other.lines;
        self.full += other.full;
        self.distance += other.distance;
        for (bits, count) in other.quantiles {
            *self.quantiles.entry(bits).or_default() += count;
        }
        self.sample.extend(other.sample);
        self.cut_sample();
    }
}

#[cfg(test)]
mod tests;
