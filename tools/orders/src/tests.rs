//! Is every order a permutation, whatever it is given, and does it hold no more than it says?

use super::*;
use crate::trial::{STORAGE, STORE, queries};
use pm_curves::hilbert_keys;
use pm_formats::vocabulary::measure;
use pm_formats::{BlockMeta, Bounds, Query};
use pm_random::Random;

fn in_a_cube(random: &mut Random) -> [f32; 3] {
    [(); 3].map(|()| random.unit())
}

/// What comes out of an order.
fn pass(order: &mut Reordering, batches: &[&[Query]]) -> Vec<(u64, Query)> {
    let mut out = vec![];
    let mut emit = |meta: BlockMeta, queries: &[Query]| {
        out.extend(queries.iter().map(|&query| (meta.batch, query)));
        Ok(())
    };
    for (batch, queries) in (0..).zip(batches) {
        for piece in queries.chunks(7) {
            order.push(BlockMeta { batch, ..BlockMeta::default() }, piece, &mut emit).unwrap();
        }
    }
    order.drain(&mut emit).unwrap();
    out
}

fn measure(order: &Reordering, name: &str) -> f64 {
    let measures = order.measures();
    measures.iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("no {name}")).1.as_f64()
}

const UNIT: Bounds = Bounds { min: [0.0; 3], max: [1.0; 3] };

fn hilbert(queries: &[Query]) -> Vec<u32> {
    hilbert_keys(&UNIT, queries, |query| query.position)
}

fn limits(memory: u64) -> Limits {
    Limits { memory, folder: std::env::temp_dir(), announce: Box::new(|| {}) }
}

fn sorted_by_hilbert(per: Per) -> Reordering {
    Reordering::new(per, Box::new(Sorted::new(hilbert, Charge::MergeSort, STORE, 0, limits(1 << 30))))
}

/// Every order in each of its forms, for the unit cube.
fn every_order(per: Per) -> Vec<(String, Reordering)> {
    let forms = trial::forms(&orders()).unwrap().into_iter();
    forms.map(|form| (form.line.clone(), form.build(per, UNIT, 1 << 30).unwrap())).collect()
}

#[test]
fn every_order_is_a_permutation() {
    trial::permutation(&orders()).unwrap();
}

#[test]
fn every_order_does_the_same_twice_and_is_called_by_its_word() {
    trial::determinism(&orders()).unwrap();
    trial::label(&orders()).unwrap();
}

#[test]
fn every_order_keeps_to_its_store() {
    trial::store(&orders()).unwrap();
    let all = queries(20_000, in_a_cube);
    for per in [Per::Batch, Per::Image] {
        for (name, mut order) in every_order(per) {
            let (first, second) = all.split_at(5000);
            pass(&mut order, &[first, second]);
            let tables = order.order().costs().tables();
            match name.split(' ').next() {
                // Addresses of 37 buckets beside the store.
                Some("hashed") if name == "hashed" => assert_eq!(tables, 37 * 8),
                Some("hashed" | "leaf" | "cells" | "hybrid" | "radius" | "buffered") => assert!(tables > 0, "{name}"),
                _ => assert_eq!(tables, 0, "{name}"),
            }
            let written = measure(&order, measure::SPILLED_WRITTEN);
            // The windows of the default hash and hint are larger than this store.
            let within = ["snowplow", "buffered", "hashed --buckets", "hint --bits", "hint --key normal"];
            let spills = !within.iter().any(|word| name.starts_with(word));
            assert_eq!(written > 0.0, spills, "{name}: {written} bytes spilled");
        }
    }
}

#[test]
fn streaming_orders_hold_no_more_of_a_longer_stream() {
    trial::streaming(&orders()).unwrap();
    let room = STORE.room() as f64;
    for (name, most) in [
        ("hashed --buckets 7 --capacity 16", 7.0 * 16.0),
        ("hashed --cell 0.03125", 37.0 * 128.0),
        ("hint", 1024.0),
        ("snowplow", room),
        ("buffered --photons map.pmp --leaf-photons 64", room),
    ] {
        let peak = |n: u32| {
            let all = queries(n, in_a_cube);
            let (_, mut order) = every_order(Per::Image).into_iter().find(|(known, _)| known == name).unwrap();
            pass(&mut order, &[&all]);
            measure(&order, measure::PEAK_QUERIES_HELD)
        };
        let (short, long) = (peak(20_000), peak(200_000));
        assert!(long <= most && short > 0.8 * most, "{name}: {short} of 20,000, {long} of 200,000");
    }
}

#[test]
fn memory_changes_no_query_and_no_measure() {
    trial::memory(&orders()).unwrap();
}

#[test]
fn temporary_files_are_announced_once() {
    let announced = std::rc::Rc::new(std::cell::Cell::new(0));
    let count = announced.clone();
    let announce = Box::new(move || count.set(count.get() + 1));
    let limits = Limits { memory: 64 << 10, folder: std::env::temp_dir(), announce };
    let mut order = Reordering::new(Per::Image, Box::new(Sorted::new(hilbert, Charge::MergeSort, STORE, 0, limits)));
    let all = queries(5000, in_a_cube);
    pass(&mut order, &[&all[..1000]]);
    assert_eq!(announced.get(), 0);
    pass(&mut order, &[&all]);
    assert_eq!(announced.get(), 1);
}

#[test]
fn per_batch_stays_in_its_batch_and_per_image_is_one() {
    trial::batches(&orders()).unwrap();
    let all = queries(300, in_a_cube);
    let (first, second) = all.split_at(100);
    let out = pass(&mut sorted_by_hilbert(Per::Image), &[first, second]);
    let keys = hilbert(&out.iter().map(|&(_, query)| query).collect::<Vec<_>>());
    assert!(keys.is_sorted());
}

#[test]
fn equal_keys_keep_their_order() {
    let all = queries(50, |_| [0.25; 3]);
    let out: Vec<_> = pass(&mut sorted_by_hilbert(Per::Image), &[&all]).into_iter().map(|(_, query)| query).collect();
    assert_eq!(out, all);
}

#[test]
fn a_partition_is_the_curve() {
    let all = queries(20_000, in_a_cube);
    let sorted = Sorted::new(hilbert, Charge::Partitions(Partitions::new()), STORE, 0, limits(1 << 30));
    let mut partition = Reordering::new(Per::Image, Box::new(sorted));
    assert!(pass(&mut partition, &[&all]) == pass(&mut sorted_by_hilbert(Per::Image), &[&all]));
    // What is told of it: all out and in once, of partitions that fit the store.
    let once = 20_000.0 * 44.0;
    assert!((once..1.1 * once).contains(&measure(&partition, measure::SPILLED_WRITTEN)));
    assert!(measure(&partition, "partitions") >= once / STORAGE as f64);
}

#[test]
fn what_does_nothing_is_refused() {
    for (line, said) in [
        ("hilbert --seed 3", "--seed is for random, not for hilbert: leave --seed out"),
        ("leaf", "leaf needs --photons: give --photons FILE"),
        (
            "hashed --leaf-photons 3",
            "--leaf-photons is for leaf, cells, hybrid, radius, buffered, not for hashed: leave --leaf-photons out",
        ),
    ] {
        assert_eq!(orders().choose(line).err().map(|error| error.to_string()).as_deref(), Some(said));
    }
    for (line, said) in [
        ("buffered --photons map.pmp --cell 0.5", "--cell does nothing with --photons"),
        ("buffered --leaf-photons 64", "--leaf-photons does nothing without --photons"),
        ("buffered --cell 0.01", "buffered has at most 16384 cells, not 1000000: give a larger --cell"),
    ] {
        let form = trial::Form { line: line.into(), chosen: orders().choose(line).unwrap() };
        let error = form.build(Per::Image, UNIT, 1 << 30).err().expect(line);
        assert!(error.what.starts_with(said), "{error}");
    }
}

#[test]
fn the_documentation_lists_every_order() {
    let readme = include_str!("../README.md");
    assert!(readme.contains(&orders().table()), "tools/orders/README.md should hold:\n{}", orders().table());
}
