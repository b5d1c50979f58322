//! Buffers that share a store: when it is full, the best one leaves.

use crate::{Costs, Outlet, Reorder, Store};
use pm_formats::Query;
use std::collections::VecDeque;

/// Bytes of a cell's first and last query and their number, on chip.
const CELL_BYTES: u64 = 12;
/// Bytes by which a query points to the next of its cell.
const LINK_BYTES: u64 = 4;
/// Cells that left last: part of what they read of the map is still in the cache.
const RECENT: usize = 2;
/// Share of its cost that such a cell, or a neighbour by number, is charged: one half.
const RECENT_SHARE: usize = 2;

/// Queries wait in the buffers of their cells. The benefit of emptying one is the number of its queries, its cost what has
/// to be fetched of the map: the same for all cells, but half of it for those that left last and their neighbours.
pub(super) struct CellBuffers<C> {
    cell: C,
    buffers: Vec<VecDeque<Query>>,
    recent: VecDeque<usize>,
    held: u64,
    room: u64,
    costs: Costs,
}

impl<C: Fn(&Query) -> u32> CellBuffers<C> {
    /// Buffers for cells that `cell` finds, below `cells`. Their table and the links are part of the store; `tables`
    /// are bytes besides.
    pub(super) fn new(cell: C, cells: u32, store: Store, tables: u64) -> Self {
        let mut costs = Costs::new(store);
        let table = u64::from(cells) * CELL_BYTES;
        let room = (store.bytes.saturating_sub(table) / (store.record.bytes() + LINK_BYTES)).max(1);
        costs.set_tables(table + room * LINK_BYTES + tables);
        let buffers = vec![VecDeque::new(); cells.max(1) as usize];
        Self { cell, buffers, recent: VecDeque::new(), held: 0, room, costs }
    }

    /// The buffer that leaves next.
    fn best(&self) -> usize {
        let near = |cell: usize| self.recent.iter().any(|&recent| recent.abs_diff(cell) <= 1);
        // Benefit over cost, which is 1, or a share of it.
        let score = |cell: usize| self.buffers[cell].len() * if near(cell) { RECENT_SHARE } else { 1 };
        // Of equally good ones the first.
        (0..self.buffers.len()).rev().max_by_key(|&cell| score(cell)).expect("there is a cell")
    }

    fn empty_best(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        let best = self.best();
        self.held -= self.buffers[best].len() as u64;
        for query in self.buffers[best].drain(..) {
            self.costs.release(true);
            out.leave(query)?;
        }
        self.recent.push_back(best);
        if self.recent.len() > RECENT {
            self.recent.pop_front();
        }
        Ok(())
    }
}

impl<C: Fn(&Query) -> u32> Reorder for CellBuffers<C> {
    fn push(&mut self, queries: &[Query], out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        for &query in queries {
            if self.held == self.room {
                self.empty_best(out)?;
            }
            self.costs.admit();
            self.held += 1;
            self.buffers[(self.cell)(&query) as usize].push_back(query);
        }
        Ok(())
    }

    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        while self.held > 0 {
            self.empty_best(out)?;
        }
        Ok(())
    }

    fn costs(&self) -> &Costs {
        &self.costs
    }
}
