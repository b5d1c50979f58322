//! Which method runs which order.

use super::machine::{Machine, UNIT};
use super::parting::{Key, by_casts, by_cells, by_partitions};
use super::sorting::sort;
use super::{linking, waiting};
use crate::deferred::hint::{self, Key as Hint};
use crate::deferred::radius::Octaves;
use crate::deferred::residents::Residents;
use crate::trial::{Form, photons};
use crate::{Keys, MedianSplit};
use pm_curves::{Grid, hilbert_keys, morton_keys};
use pm_formats::Query;

/// The queries pass through the machine as the order's own method has it.
pub(super) fn run(form: &Form, machine: &mut Machine, queries: &[Query]) {
    let values = &form.chosen.values;
    let count = |name: &str| values.count::<u64>(name);
    let n = queries.len() as u64;
    let hilbert = |query: &Query| hilbert_keys(&UNIT, &[*query], |query| query.position)[0];
    match form.chosen.entry.word() {
        "hilbert" => merge(machine, queries, &hilbert),
        "morton" => merge(machine, queries, &|query| morton_keys(&UNIT, &[*query], |query| query.position)[0]),
        "random" => merge(machine, queries, &|query| {
            let mut random = pm_random::Random::new(&[count("seed"), query.pixel.into(), query.sample.into()]);
            (random.next_u64() >> 32) as u32
        }),
        "partition" => by_partitions(machine, queries, &hilbert),
        "leaf" => {
            let split = split(machine, count("leaf-photons"));
            merge(machine, queries, &|query| split.cell(query.position));
        }
        "cells" => {
            let split = split(machine, count("leaf-photons"));
            by_cells(machine, queries, n, split.cells().into(), &|query| split.cell(query.position));
        }
        "radius" => {
            let leaf = count("leaf-photons");
            // The tree, and a byte for each of its cells.
            let cells = u64::from(split(machine, leaf).cells());
            machine.chip.reserve(cells);
            let octaves = Octaves::new(photons(), leaf as usize);
            by_cells(machine, queries, n, octaves.parts().into(), &|query| octaves.part(query));
        }
        "hybrid" => {
            let leaf = count("leaf-photons");
            let cells = u64::from(split(machine, leaf).cells());
            // Photons and queries in the sample, then the cast.
            machine.chip.reserve(cells * (4 + 4));
            let (resident, casts) = (count("resident"), count("casts") as u32);
            by_casts(machine, queries, Residents::new(photons(), leaf as usize, resident, casts));
        }
        "snowplow" => waiting::replacement(machine, queries, &hilbert),
        "hint" => {
            let keys: Keys = hint::keys(values.choice::<Hint>("key"), count("bits") as u32, UNIT);
            waiting::windows(machine, queries, count("window") as usize, &|query| keys(&[*query])[0]);
        }
        "hashed" => {
            let (buckets, capacity) = (count("buckets"), count("capacity") as usize);
            let grid = values.length_if_any("cell").map(|side| Grid::of_side(&UNIT, side, 1 << 24));
            let grid = grid.unwrap_or_else(|| Grid::across(&UNIT, 8));
            let hash = |query: &Query| {
                let [x, y, z] = grid.cell(query.position);
                let hash = x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ z.wrapping_mul(83_492_791);
                hash % buckets as u32
            };
            waiting::buckets(machine, queries, buckets as usize, capacity, &hash);
        }
        "buffered" if values.file().is_some() => {
            let split = split(machine, count("leaf-photons"));
            linking::buffers(machine, queries, split.cells() as usize, &|query| split.cell(query.position));
        }
        "buffered" => {
            let grid = Grid::across(&UNIT, 8);
            let cell = |query: &Query| grid.cell(query.position).into_iter().rev().fold(0, |cell, at| cell * 8 + at);
            linking::buffers(machine, queries, 8 * 8 * 8, &cell);
        }
        word => panic!("no machine runs {word}: give it a method here"),
    }
}

/// A merge sort that has the store, with what is left of it beside whole records.
fn merge(machine: &mut Machine, queries: &[Query], key: Key<'_>) {
    let (n, store) = (queries.len() as u64, machine.store);
    let rest = store.bytes - machine.bytes(store.room());
    machine.chip.reserve(if n > store.room() { rest } else { 0 });
    sort(machine, queries.iter().copied(), n, key);
}

/// The tree of cells, a node of 8 bytes each on chip.
fn split(machine: &mut Machine, leaf: u64) -> MedianSplit {
    let split = MedianSplit::new(photons(), leaf as usize);
    // A binary tree has one node more than twice its inner ones.
    machine.chip.reserve((2 * u64::from(split.cells()) - 1) * 8);
    split
}
