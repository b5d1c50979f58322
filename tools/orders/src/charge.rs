//! What orders that hold a whole batch or image pay when it does not fit their store: by sort, by sample sort, by parts.

use super::{BURST_BUFFER, Costs, Partitions};
use pm_formats::Query;

/// How queries that do not fit the store are put in order.
pub enum Charge {
    /// An external merge sort.
    MergeSort,
    /// Into partitions that each fit the store, sorted when they are read back.
    Partitions(Partitions),
    /// Into so many cells, each read back as it came.
    Cells(u64),
}

impl Charge {
    /// Queries have come, with these keys.
    pub(super) fn came(&mut self, queries: &[Query], keys: &[u32]) {
        if let Self::Partitions(partitions) = self {
            queries.iter().zip(keys).for_each(|(query, &key)| partitions.sample(query, key));
        }
    }

    /// All have come: `n` queries.
    pub(super) fn all_came(&mut self, n: u64, costs: &Costs) {
        if let Self::Partitions(partitions) = self {
            partitions.decide(n, costs.store());
        }
    }

    /// A query leaves, in the order of keys.
    pub(super) fn left(&mut self, key: u32) {
        if let Self::Partitions(partitions) = self {
            partitions.count(key);
        }
    }

    /// All `n` have left.
    pub(super) fn all_left(&mut self, n: u64, costs: &mut Costs) {
        let store = costs.store();
        if n <= store.room() {
            costs.group(n, 0, n * store.record.bytes());
            return;
        }
        match self {
            Self::MergeSort => costs.group(n, store.spilled_by_sort(n), store.bytes),
            Self::Partitions(partitions) => partitions.charge(n, costs),
            Self::Cells(cells) => {
                // A buffer for each cell while they are written, one while they are read.
                let buffers = (*cells + 1).min(store.fan()) * BURST_BUFFER;
                costs.group(n, n * store.passes_to_part(*cells), buffers);
            }
        }
    }
}
