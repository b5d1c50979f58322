//! Evicts a line whose next use is predicted to be distant.

use std::collections::BTreeMap;

use super::Policy;
use crate::models::{CacheModel, CacheOnTrace, Replacement};
use crate::trial::{Definition, FullSet};

pm_registry::registered! {
    /// The first line whose next use is predicted to be distant: SRRIP, 2 bits, hit priority (Jaleel 2010)
    pub(crate) struct Srrip = "srrip";
}

impl Policy for Srrip {
    fn model(&self, cache: &CacheOnTrace) -> Box<dyn CacheModel> {
        cache.replacing(Intervals { of: vec![0; cache.sets() * cache.ways()], ways: cache.ways() })
    }
    fn definition(&self, _: u64, _: u64, _: u64) -> Box<dyn Definition> {
        Box::new(Ageing::default())
    }
}

/// The prediction for a line that was used again: near.
const NEAR: u8 = 0;
/// For a line that came in: long.
const LONG: u8 = 2;
/// For one that may go: distant.
const DISTANT: u8 = 3;

/// By set and way, the predicted interval to the next use (Jaleel, Theobald, Steely and Emer, *High performance cache
/// replacement using re-reference interval prediction*, ISCA 2010, section 3).
struct Intervals {
    of: Vec<u8>,
    ways: usize,
}

impl Replacement for Intervals {
    // A line that came in is predicted otherwise once it is used at once.
    const REPEATS_MATTER: bool = true;

    #[inline]
    fn hit(&mut self, set: usize, way: usize) {
        self.of[set * self.ways + way] = NEAR;
    }

    #[inline]
    fn fill(&mut self, set: usize, way: usize) {
        self.of[set * self.ways + way] = LONG;
    }

    #[inline]
    fn victim(&mut self, set: usize) -> usize {
        let ways = &mut self.of[set * self.ways..][..self.ways];
        // All age until one is distant: by as much as the oldest lacks.
        let oldest = ways.iter().fold(NEAR, |oldest, &of| oldest.max(of));
        ways.iter_mut().for_each(|of| *of += DISTANT - oldest);
        ways.iter().position(|&of| of == DISTANT).unwrap_or(0)
    }
}

/// The definition: by set, the predictions for its lines, which age one by one.
#[derive(Default)]
struct Ageing(BTreeMap<u64, BTreeMap<u64, (usize, u8)>>);

impl Definition for Ageing {
    fn victim(&mut self, full: &FullSet) -> Option<usize> {
        let known = self.0.entry(full.set()).or_default();
        // By line: how often it was used when it was last looked at, and what was predicted then.
        let mut predicted: Vec<u8> = vec![];
        for held in full.held() {
            let uses = held.uses().len();
            // One that came in anew begins with a use.
            let before = known.get(&held.line()).filter(|(seen, _)| *seen >= held.came()).map(|(_, of)| *of);
            let used_since = match (known.get(&held.line()), before) {
                (Some((seen, _)), Some(_)) => held.uses().iter().any(|&at| at > *seen),
                _ => uses > 1,
            };
            predicted.push(if used_since { NEAR } else { before.unwrap_or(LONG) });
        }
        let victim = loop {
            if let Some(way) = predicted.iter().position(|&of| of == DISTANT) {
                break way;
            }
            predicted.iter_mut().for_each(|of| *of += 1);
        };
        *known = full.held().iter().zip(predicted).map(|(held, of)| (held.line(), (full.now(), of))).collect();
        Some(victim)
    }
}
