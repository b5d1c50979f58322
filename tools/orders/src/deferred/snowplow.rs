//! A streaming order along a curve through the scene: the store is always full, and the next query on the curve leaves.
//!
//! Replacement selection (Knuth, *The Art of Computer Programming* 3, 5.4.1): like a snow plough on a ring road while it
//! snows, each round clears twice what lies at any one time. So the searches go through the map once for twice as many
//! queries as the store holds, where sorting one store's worth after the other goes through it for each.

use super::hilbert;
use crate::{Costs, Order, Outlet, Reorder, Setting, Store};
use pm_formats::Query;
use pm_registry::{ParameterError, Values};
use pm_size::Bytes;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

pm_registry::registered! {
    /// Along a Hilbert curve, round after round: the next on the curve leaves when the store is full; streaming
    pub struct Snowplow = "snowplow";
}

impl Order for Snowplow {
    fn label(&self, _: &Values, store: Store) -> String {
        format!("snowplow {}", Bytes(store.bytes))
    }

    fn is_streaming(&self) -> bool {
        true
    }

    fn build(&self, setting: Setting<'_>) -> Result<Box<dyn Reorder>, ParameterError> {
        Ok(Box::new(ReplacementSelection::new(hilbert::keys(setting.bounds), setting.store)))
    }
}

/// Queries by key and, of equal keys, by when they came; with their index among the held.
type Waiting = BinaryHeap<Reverse<(u32, u64, u32)>>;

/// An order by 32-bit keys with a store of bounded size.
struct ReplacementSelection<K> {
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

impl<K: Fn(&[Query]) -> Vec<u32>> ReplacementSelection<K> {
    /// An order whose keys `key` computes, for many queries at once.
    fn new(key: K, store: Store) -> Self {
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
        let Some(Reverse((key, _, index))) = self.rounds[0].pop() else { return Ok(false) };
        self.at = key;
        self.costs.release(true);
        self.free.push(index);
        out.leave(self.held[index as usize])?;
        Ok(true)
    }

    fn hold(&mut self, key: u32, query: Query) {
        self.costs.admit();
        let index = self.free.pop().unwrap_or_else(|| {
            self.held.push(query);
            (self.held.len() - 1) as u32
        });
        self.held[index as usize] = query;
        self.rounds[usize::from(key < self.at)].push(Reverse((key, self.came, index)));
        self.came += 1;
    }
}

impl<K: Fn(&[Query]) -> Vec<u32>> Reorder for ReplacementSelection<K> {
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

    fn costs(&self) -> &Costs {
        &self.costs
    }
}

#[cfg(test)]
mod tests;
