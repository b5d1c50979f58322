//! Orders that sort by a key: all of a batch, or all of the image, has to be held.

use super::by_key::sorted_by_key;
use super::runs::Runs;
use super::{Charge, Costs, Outlet, Reorder, Store};
use pm_formats::Query;
use std::path::PathBuf;

/// Memory of this machine that an order may use, and where it goes beyond.
pub struct Limits {
    /// Bytes of memory.
    pub memory: u64,
    /// Folder for temporary files.
    pub folder: PathBuf,
    /// Called when the first of them is made.
    pub announce: Box<dyn Fn()>,
}

/// Bytes of memory for each query that is sorted: the record, its key, and key and index together.
const BYTES_A_QUERY: u64 = (size_of::<Query>() + size_of::<u32>() + size_of::<u64>()) as u64;

/// Queries that are asked for at a time.
const TOGETHER: usize = 64;

/// The system has less memory than [`Limits`] allow.
pub(super) fn no_memory() -> pm_formats::Error {
    let text = "not enough memory to sort all queries in; with less --memory they are sorted in temporary files";
    std::io::Error::new(std::io::ErrorKind::OutOfMemory, text).into()
}

/// Sorts queries by a 32-bit key; equal keys keep the order in which they came.
pub struct Sorted<K> {
    key: K,
    charge: Charge,
    costs: Costs,
    limits: Limits,
    announced: bool,
    held: Vec<Query>,
    /// The keys of those held.
    keys: Vec<u32>,
    runs: Runs,
    /// Queries of the batch in hand, in memory and on disk.
    queries: u64,
}

impl<K: Fn(&[Query]) -> Vec<u32>> Sorted<K> {
    /// An order whose keys `key` computes, for many queries at once; `tables` are the bytes that this takes on chip.
    pub fn new(key: K, charge: Charge, store: Store, tables: u64, limits: Limits) -> Self {
        let mut costs = Costs::new(store);
        costs.set_tables(tables);
        let runs = Runs::new(limits.folder.clone(), limits.memory);
        Self { key, charge, costs, limits, announced: false, held: vec![], keys: vec![], runs, queries: 0 }
    }

    /// What is held in memory, sorted: keys, and indices among the held.
    fn sort_held(&mut self) -> pm_formats::Result<Vec<u64>> {
        self.charge.came(&self.held, &self.keys);
        let sorted = sorted_by_key(&self.keys).ok_or_else(no_memory)?;
        self.keys.clear();
        Ok(sorted)
    }

    /// Moves what is held in memory to the disk.
    fn spill_run(&mut self) -> pm_formats::Result<()> {
        if !std::mem::replace(&mut self.announced, true) {
            (self.limits.announce)();
        }
        let sorted = self.sort_held()?;
        let held = &self.held;
        self.runs.add(sorted.iter().map(|&at| ((at >> 32) as u32, held[(at & 0xffff_ffff) as usize])))?;
        self.held.clear();
        Ok(())
    }
}

impl<K: Fn(&[Query]) -> Vec<u32>> Reorder for Sorted<K> {
    fn push(&mut self, queries: &[Query], _: &mut Outlet<'_>) -> pm_formats::Result<()> {
        self.queries += queries.len() as u64;
        let most = (self.limits.memory / BYTES_A_QUERY).clamp(1, 1 << 32) as usize;
        let mut rest = queries;
        while !rest.is_empty() {
            if self.held.len() == most {
                self.spill_run()?;
            }
            let (now, later) = rest.split_at(rest.len().min(most - self.held.len()));
            self.held.try_reserve(now.len()).map_err(|_| no_memory())?;
            self.keys.try_reserve(now.len()).map_err(|_| no_memory())?;
            self.held.extend_from_slice(now);
            // While they are near: later each would have to come from memory again.
            self.keys.extend((self.key)(now));
            rest = later;
        }
        Ok(())
    }

    fn drain(&mut self, out: &mut Outlet<'_>) -> pm_formats::Result<()> {
        let n = std::mem::take(&mut self.queries);
        if self.runs.is_empty() {
            let sorted = self.sort_held()?;
            self.charge.all_came(n, &self.costs);
            for some in sorted.chunks(TOGETHER) {
                let query = |at: u64| &self.held[(at & 0xffff_ffff) as usize];
                // Each lies anywhere in memory. Asked for one after the other with nothing else between, they come together.
                let asked = some.iter().fold(0, |asked, &at| asked ^ query(at).pixel ^ query(at).weight[2].to_bits());
                std::hint::black_box(asked);
                for &at in some {
                    self.charge.left((at >> 32) as u32);
                    out.leave(*query(at))?;
                }
            }
            self.held.clear();
        } else {
            self.spill_run()?;
            // Their memory is needed for the buffers.
            (self.held, self.keys) = (vec![], vec![]);
            self.charge.all_came(n, &self.costs);
            let charge = &mut self.charge;
            self.runs.drain(|key, query| {
                charge.left(key);
                out.leave(query)
            })?;
        }
        self.charge.all_left(n, &mut self.costs);
        Ok(())
    }

    fn costs(&self) -> &Costs {
        &self.costs
    }
}
