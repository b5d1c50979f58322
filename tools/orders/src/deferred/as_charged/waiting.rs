//! Queries that wait one by one, in the store or, where a window is larger, in memory.

use super::machine::Machine;
use super::parting::Key;
use pm_formats::Query;
use std::collections::VecDeque;
use std::fs::File;
use std::os::unix::fs::FileExt as _;

/// Where a query waits.
enum Place {
    Store(Vec<u8>),
    Memory(u64),
}

/// The store, and a file for what does not fit it.
struct Places {
    file: File,
    end: u64,
    inside: u64,
}

impl Places {
    fn new() -> Self {
        Self { file: tempfile::tempfile().unwrap(), end: 0, inside: 0 }
    }

    fn put(&mut self, machine: &mut Machine, query: &Query, key: u32) -> Place {
        let record = machine.stored(query, key);
        if self.inside < machine.store.room() {
            self.inside += 1;
            machine.chip.reserve(record.len() as u64);
            return Place::Store(record);
        }
        let at = self.end;
        self.file.write_all_at(&record, at).unwrap();
        self.end += record.len() as u64;
        machine.written += record.len() as u64;
        Place::Memory(at)
    }

    fn leave(&mut self, machine: &mut Machine, place: Place) {
        let record = match place {
            Place::Store(record) => {
                self.inside -= 1;
                machine.chip.release(record.len() as u64);
                record
            }
            Place::Memory(at) => {
                let mut record = vec![0; machine.bytes(1) as usize];
                self.file.read_exact_at(&mut record, at).unwrap();
                machine.read += record.len() as u64;
                record
            }
        };
        let query = machine.query(&record);
        machine.left.push(query);
    }
}

/// Windows of so many, each sorted by key.
pub(super) fn windows(machine: &mut Machine, came: &[Query], window: usize, key: Key<'_>) {
    let mut places = Places::new();
    for window in came.chunks(window) {
        let mut held: Vec<_> =
            window.iter().map(|query| (key(query), places.put(machine, query, key(query)))).collect();
        held.sort_by_key(|held| held.0);
        held.into_iter().for_each(|(_, place)| places.leave(machine, place));
    }
}

/// Buckets, each of so many at most: the current one is emptied, then the fullest.
pub(super) fn buckets(machine: &mut Machine, came: &[Query], buckets: usize, capacity: usize, bucket: Key<'_>) {
    machine.chip.reserve(buckets as u64 * 8);
    let mut places = Places::new();
    let mut full: Vec<VecDeque<Place>> = (0..buckets).map(|_| VecDeque::new()).collect();
    let mut current = None;
    let mut leave = |machine: &mut Machine, places: &mut Places, full: &mut Vec<VecDeque<Place>>| {
        let fullest = || (1..buckets).fold(0, |best, at| if full[at].len() > full[best].len() { at } else { best });
        let from = current.filter(|&current: &usize| !full[current].is_empty()).unwrap_or_else(fullest);
        current = Some(from);
        let place = full[from].pop_front();
        place.map(|place| places.leave(machine, place)).is_some()
    };
    for query in came {
        let bucket = bucket(query) as usize;
        while full[bucket].len() == capacity {
            leave(machine, &mut places, &mut full);
        }
        let place = places.put(machine, query, 0);
        full[bucket].push_back(place);
    }
    while leave(machine, &mut places, &mut full) {}
}

/// Replacement selection, in a store without pointers: records lie as they came, and a search through all finds the next. A
/// key below that of the last to leave is of the next round.
pub(super) fn replacement(machine: &mut Machine, came: &[Query], key: Key<'_>) {
    let mut places = Places::new();
    let mut held: Vec<(u32, Place)> = vec![];
    let mut at = 0;
    let mut leave = |machine: &mut Machine, places: &mut Places, held: &mut Vec<(u32, Place)>| {
        let of_round = |at: u32| (0..held.len()).filter(|&i| held[i].0 >= at).min_by_key(|&i| held[i].0);
        let next = of_round(at).or_else(|| of_round(0));
        next.map(|next| {
            let (key, place) = held.remove(next);
            at = key;
            places.leave(machine, place);
        })
    };
    for query in came {
        if held.len() as u64 == machine.store.room() {
            leave(machine, &mut places, &mut held);
        }
        let key = key(query);
        held.push((key, places.put(machine, query, key)));
    }
    while leave(machine, &mut places, &mut held).is_some() {}
}
