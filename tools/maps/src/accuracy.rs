//! How near to the truth an approximate map comes: on a sample of queries, against an exact map.

use super::{AccessObserver, Nearest, PhotonMap, Search};
use std::collections::BTreeSet;

/// What was found of what there was to find.
///
/// A query's *recall* is the share of its true k nearest photons that were found; its *dilation* the distance of the
/// farthest photon found over that of the farthest true one, both of as many photons as were found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Accuracy {
    /// Queries compared.
    pub queries: u64,
    /// Sum of recalls.
    recall: f64,
    /// Least recall of a query.
    pub least_recall: f64,
    dilation: f64,
    /// Largest dilation of a query.
    pub largest_dilation: f64,
    /// Queries of finite dilation.
    dilated: u64,
    /// Blocks that hold a true neighbour of some query, and that this query did not read; summed over the queries.
    pub blocks_missed: u64,
    wanted: BTreeSet<u32>,
    reached: BTreeSet<u32>,
}

/// Remembers which records of one region are read.
struct Reached<'a> {
    region: u16,
    records: &'a mut BTreeSet<u32>,
}

impl AccessObserver for Reached<'_> {
    fn read(&mut self, region: u16, record: u32) {
        if region == self.region {
            self.records.insert(record);
        }
    }
}

impl Accuracy {
    /// Compares the answers of `map` with those of `truth` at these points. `blocks`: the region of the map's photon
    /// blocks, and the block of each photon. `compare` is shown the point's number, what was found, and the truth.
    #[must_use]
    pub fn measure(
        map: &(impl PhotonMap + ?Sized),
        truth: &impl PhotonMap,
        search: Search,
        points: &[[f32; 3]],
        blocks: Option<(u16, &[u32])>,
        mut compare: impl FnMut(usize, &Nearest, &Nearest),
    ) -> Self {
        let mut accuracy = Self { least_recall: 1.0, ..Self::default() };
        let (mut found, mut expected) = (Nearest::new(search.k, 0.0), Nearest::new(search.k, 0.0));
        let plain = Search::new(search.k, search.max_dist);
        for (number, &point) in points.iter().enumerate() {
            let mut records = BTreeSet::new();
            let region = blocks.map_or(u16::MAX, |(region, _)| region);
            plain.run(map, point, &mut found, &mut Reached { region, records: &mut records });
            search.run(truth, point, &mut expected, &mut super::Blind);
            accuracy.add(&found.sorted(), &expected.sorted());
            compare(number, &found, &expected);
            if let Some((_, block_of)) = blocks {
                let wanted: BTreeSet<u32> = expected.iter().map(|(_, id)| block_of[id as usize]).collect();
                accuracy.blocks_missed += wanted.difference(&records).count() as u64;
                accuracy.wanted.extend(wanted);
                accuracy.reached.extend(records);
            }
        }
        accuracy
    }

    fn add(&mut self, found: &[(f32, u32)], expected: &[(f32, u32)]) {
        self.queries += 1;
        let true_ids: BTreeSet<u32> = expected.iter().map(|&(_, id)| id).collect();
        let hits = found.iter().filter(|(_, id)| true_ids.contains(id)).count();
        let recall = if expected.is_empty() { 1.0 } else { hits as f64 / expected.len() as f64 };
        self.recall += recall;
        self.least_recall = self.least_recall.min(recall);
        let Some((&(far, _), &(true_far, _))) = found.last().zip(expected.get(found.len().saturating_sub(1))) else {
            return;
        };
        let dilation = if far == true_far { 1.0 } else { (f64::from(far) / f64::from(true_far)).sqrt() };
        if dilation.is_finite() {
            self.dilation += dilation;
            self.dilated += 1;
        }
        self.largest_dilation = self.largest_dilation.max(dilation);
    }

    /// Mean recall; 1 if nothing was compared.
    #[must_use]
    pub fn mean_recall(&self) -> f64 {
        if self.queries == 0 { 1.0 } else { self.recall / self.queries as f64 }
    }

    /// Mean dilation of those queries that found anything.
    #[must_use]
    pub fn mean_dilation(&self) -> f64 {
        if self.dilated == 0 { 1.0 } else { self.dilation / self.dilated as f64 }
    }

    /// Blocks that hold a true neighbour of some query, and that no query read.
    #[must_use]
    pub fn blocks_unreached(&self) -> u64 {
        self.wanted.difference(&self.reached).count() as u64
    }

    /// Blocks that hold a true neighbour of some query.
    #[must_use]
    pub fn blocks_wanted(&self) -> u64 {
        self.wanted.len() as u64
    }
}

#[cfg(test)]
mod tests;
