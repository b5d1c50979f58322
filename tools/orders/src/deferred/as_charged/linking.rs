//! Buffers of cells that share a store: a table of cells, and links from query to query.

use super::machine::Machine;
use super::parting::Key;
use pm_formats::Query;

/// No query.
const NONE: u32 = u32::MAX;

/// A store of records with links.
struct Linked {
    records: Vec<Vec<u8>>,
    links: Vec<u32>,
    /// The first place that is free; each links to the next.
    free: u32,
    /// Of each cell: first, last, number.
    table: Vec<[u32; 3]>,
    /// Cells that left last.
    recent: [usize; 2],
}

/// Buffers of so many cells: when the store is full, the best by benefit over cost leaves.
pub(super) fn buffers(machine: &mut Machine, came: &[Query], cells: usize, cell: Key<'_>) {
    let table = cells as u64 * 12;
    let room = ((machine.store.bytes - table) / (machine.bytes(1) + 4)).max(1) as usize;
    machine.chip.reserve(table + room as u64 * 4);
    let mut store = Linked {
        records: vec![vec![]; room],
        links: (1..room as u32).chain([NONE]).collect(),
        free: 0,
        table: vec![[NONE, NONE, 0]; cells],
        recent: [usize::MAX; 2],
    };
    for query in came {
        if store.free == NONE {
            store.empty(machine);
        }
        let cell = cell(query);
        store.put(machine.stored(query, cell), cell as usize);
        machine.chip.reserve(machine.bytes(1));
    }
    while store.table.iter().any(|&[_, _, number]| number > 0) {
        store.empty(machine);
    }
}

impl Linked {
    fn put(&mut self, record: Vec<u8>, cell: usize) {
        let at = self.free;
        self.free = std::mem::replace(&mut self.links[at as usize], NONE);
        self.records[at as usize] = record;
        let [first, last, number] = &mut self.table[cell];
        if *number == 0 {
            *first = at;
        } else {
            self.links[*last as usize] = at;
        }
        (*last, *number) = (at, *number + 1);
    }

    /// The best cell leaves: that with most queries, counted twice where a cell or its neighbour by number left lately.
    fn empty(&mut self, machine: &mut Machine) {
        let near = |cell: usize| self.recent.iter().any(|&recent| recent.abs_diff(cell) <= 1);
        let score = |cell: usize| self.table[cell][2] * if near(cell) { 2 } else { 1 };
        let best = (1..self.table.len()).fold(0, |best, cell| if score(cell) > score(best) { cell } else { best });
        let [mut at, _, _] = std::mem::replace(&mut self.table[best], [NONE, NONE, 0]);
        while at != NONE {
            let query = machine.query(&std::mem::take(&mut self.records[at as usize]));
            machine.left.push(query);
            machine.chip.release(machine.bytes(1));
            let next = std::mem::replace(&mut self.links[at as usize], self.free);
            (self.free, at) = (at, next);
        }
        self.recent = [self.recent[1], best];
    }
}
