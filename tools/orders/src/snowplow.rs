//! A streaming order along a curve through the scene: the store is always full, and the next query on the curve leaves.
//!
//! Replacement selection (Knuth, *The Art of Computer Programming* 3, 5.4.1): like a snow plough on a ring road while it
//! snows, each round clears twice what lies at any one time. So the searches go through the map once for twice as many
//! queries as the store holds, where sorting one store's worth after the other goes through it for each.

use super::cost::{Costs, Store};
use super::{Outlet, Reorder};
use pm_formats::{Number, Query};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Queries by key and, of equal keys, by when they came; with their place among the held.
type Waiting = BinaryHeap<Reverse<(u32, u64, u32)>>;

/// An order by 32-bit keys with a store of bounded size.
pub struct Snowplow<K> {
    key: K,
    /// For the round under way, and for the next.
    rounds: [Waiting; 2],
    /// Key of the query that left last.
    at: u32,
    held: Vec<Query>,
    free: Vec<u32>,
    came: u64,
    costs: Costs,
}

impl<K: Fn(&[Query]) -> Vec<u32>> Snowplow<K> {
    /// An order whose keys `key` computes, for many queries at once.
    pub fn new(key: K, store: Store) -> Self {
        Self {
            key,
            rounds: [BinaryHeap::new(), BinaryHeap::new()],
            at: 0,
            held: vec![],
            free: vec![],
            came: 0,
            costs: Costs::new(store),
        }
    }

    /// The next query on the curve leaves, if there is one.
    fn pop(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<bool> {
        if self.rounds[0].is_empty() {
            self.rounds.swap(0, 1);
            self.at = 0;
        }
        let Some(Reverse((key, _, place))) = self.rounds[0].pop() else { return Ok(false) };
        self.at = key;
        self.costs.release(true);
        self.free.push(place);
        out.leave(self.held[place as usize])?;
        Ok(true)
    }

    fn hold(&mut self, key: u32, query: Query) {
        self.costs.admit();
        let place = self.free.pop().unwrap_or_else(|| {
            self.held.push(query);
            (self.held.len() - 1) as u32
        });
        self.held[place as usize] = query;
        self.rounds[usize::from(key < self.at)].push(Reverse((key, self.came, place)));
        self.came += 1;
    }
}

impl<K: Fn(&[Query]) -> Vec<u32>> Reorder for Snowplow<K> {
    fn push(&mut self, queries: &[Query], out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        for (key, &query) in (self.key)(queries).into_iter().zip(queries) {
            if (self.held.len() - self.free.len()) as u64 == self.costs.store().room() {
                self.pop(out)?;
            }
            self.hold(key, query);
        }
        Ok(())
    }

    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        while self.pop(out)? {}
        Ok(())
    }

    fn measures(&self) -> Vec<(String, Number)> {
        self.costs.measures()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Per, Record, Reordering};
    use bytemuck::Zeroable as _;
    use pm_formats::BlockMeta;
    use pm_formats::vocabulary::measure;
    use pm_random::Random;

    #[test]
    fn runs_are_twice_as_long_as_the_store() {
        // Knuth's theorem for keys in random order.
        let room = 500;
        let store = Store { bytes: room * 44, record: Record::Full };
        let keys = |queries: &[Query]| queries.iter().map(|query| query.sample).collect();
        let mut order = Reordering::new(Per::Image, Box::new(Snowplow::new(keys, store)));
        let mut random = Random::new(&[5]);
        let queries: Vec<Query> =
            (0..100_000).map(|_| Query { sample: random.next_u64() as u32, ..Query::zeroed() }).collect();
        let mut out = vec![];
        let mut emit = |_: BlockMeta, queries: &[Query]| {
            out.extend(queries.iter().map(|query| query.sample));
            Ok(())
        };
        order.push(BlockMeta::default(), &queries, &mut emit).unwrap();
        order.drain(&mut emit).unwrap();
        assert_eq!(out.len(), queries.len());
        let runs = 1 + out.windows(2).filter(|pair| pair[1] < pair[0]).count();
        let length = queries.len() as f64 / runs as f64 / room as f64;
        assert!((1.9..2.1).contains(&length), "{length}");
        assert_eq!(order.measures()[0], (measure::PEAK_QUERIES_HELD.to_owned(), Number::Count(room)));
    }
}
