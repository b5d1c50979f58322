//! A sample of the queries of a batch, cast before the batch is, so that an order knows where queries will lie.

use pm_formats::Query;
use pm_random::Random;
use std::collections::BinaryHeap;

/// One of so many queries is in the sample.
const ONE_OF: u64 = 64;
/// Most queries of a sample.
const MOST: usize = 1 << 18;
/// The sample of a small picture is not smaller than this, if there are so many queries.
const LEAST: usize = 1 << 12;
/// Rays for each query of the sample: an eye ray and a gather ray.
pub(super) const RAYS_OF_A_SAMPLE: u64 = 2;

/// The queries of the least hashes, with their keys; it does not depend on when they came.
#[derive(Default)]
pub(super) struct Sample {
    least: BinaryHeap<(u64, u32)>,
    seen: u64,
}

impl Sample {
    /// A query has come: it may belong to the sample.
    pub(super) fn see(&mut self, query: &Query, key: u32) {
        self.seen += 1;
        let identity = [u64::from(query.flags), u64::from(query.pixel), u64::from(query.sample)];
        let hash = Random::new(&identity).next_u64();
        let most = usize::try_from(self.seen / ONE_OF).unwrap_or(MOST).clamp(LEAST, MOST);
        if self.least.len() < most || self.least.peek().is_some_and(|&(greatest, _)| hash < greatest) {
            self.least.push((hash, key));
            if self.least.len() > most {
                self.least.pop();
            }
        }
    }

    /// The keys of the sample, in no order; the next sample begins.
    pub(super) fn take(&mut self) -> Vec<u32> {
        self.seen = 0;
        std::mem::take(&mut self.least).into_iter().map(|(_, key)| key).collect()
    }
}
