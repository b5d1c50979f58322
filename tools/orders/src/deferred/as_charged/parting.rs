//! Queries parted into files of memory, each read back by itself.

use super::machine::{Machine, Writer};
use super::sorting::sort;
use crate::BURST_BUFFER;
use crate::deferred::residents::Residents;
use crate::partitions::Partitions;
use crate::sample::Sample;
use pm_formats::Query;
use std::collections::BTreeMap;

/// Computes the key of a query.
pub(super) type Key<'a> = &'a dyn Fn(&Query) -> u32;

/// By cells, of which there are so many; `came` is told to be `n` queries at most.
pub(super) fn by_cells(machine: &mut Machine, came: &[Query], n: u64, cells: u64, cell: Key<'_>) {
    let room = machine.store.room();
    if n <= room {
        return sort(machine, came.iter().copied(), came.len() as u64, cell);
    }
    assert!(cells <= machine.store.fan(), "one parting is all that is tried");
    // A buffer for each cell, and if there is room one to read with, from the beginning.
    let buffers = (cells + 1).min(machine.store.fan()) * BURST_BUFFER;
    machine.chip.reserve(buffers);
    let mut files: BTreeMap<u32, Writer> = BTreeMap::new();
    for query in came {
        let cell = cell(query);
        machine.write(files.entry(cell).or_insert_with(Machine::writer), query, cell);
    }
    assert!(files.len() as u64 <= cells);
    for file in files.into_values() {
        let mut reader = machine.turn(file);
        while let Some(query) = machine.next(&mut reader) {
            machine.left.push(query);
        }
    }
    machine.chip.release(buffers);
}

/// By partitions along a curve, each sorted in the store; the ends of partitions, and what each holds, lie in a directory.
pub(super) fn by_partitions(machine: &mut Machine, came: &[Query], key: Key<'_>) {
    let (n, store) = (came.len() as u64, machine.store);
    if n <= store.room() {
        return sort(machine, came.iter().copied(), n, key);
    }
    // The sample is cast first: a key each.
    let mut partitions = Partitions::new();
    let mut sample = Sample::default();
    for query in came {
        partitions.sample(query, key(query));
        sample.see(query, key(query));
    }
    let sampled = sample.take().len() as u64 * 4;
    machine.chip.reserve(sampled);
    partitions.decide(n, store);
    machine.chip.release(sampled);
    let firsts = partitions.firsts();
    assert!(firsts.len() as u64 <= store.fan(), "one parting is all that is tried");
    let buffers = firsts.len() as u64 * BURST_BUFFER;
    machine.chip.reserve(buffers);
    let mut parts: Vec<(Writer, Vec<u32>)> = firsts.iter().map(|_| (Machine::writer(), vec![])).collect();
    for query in came {
        let key = key(query);
        let (file, keys) = &mut parts[firsts.partition_point(|&first| first <= key) - 1];
        machine.write(file, query, key);
        keys.push(key);
    }
    machine.chip.release(buffers);
    for (file, keys) in parts {
        let mut reader = machine.turn(file);
        let (mixed, n) = (keys.iter().any(|&key| key != keys[0]), keys.len() as u64);
        let mut queries = vec![];
        while let Some(query) = machine.next(&mut reader) {
            queries.push(query);
        }
        if mixed && n > store.room() {
            sort(machine, queries.into_iter(), n, key);
        } else {
            // Of one key, a store's worth at a time.
            for part in queries.chunks(store.room() as usize) {
                sort(machine, part.iter().copied(), part.len() as u64, key);
            }
        }
    }
}

/// Cast by cast, what is resident leaving at once, and the rest by cells.
pub(super) fn by_casts(machine: &mut Machine, came: &[Query], mut residents: Residents) {
    let mut sample = Sample::default();
    came.iter().for_each(|query| sample.see(query, residents.cell(query.position)));
    let (casts, cells) = residents.choose(&sample.take());
    let rank = |query: &Query| residents.rank(query.position);
    for cast in 0..casts {
        machine.left.extend(came.iter().filter(|query| rank(query) == cast));
    }
    let waiting: Vec<Query> = came.iter().copied().filter(|query| !residents.at_once(rank(query))).collect();
    by_cells(machine, &waiting, came.len() as u64, cells, &rank);
}
