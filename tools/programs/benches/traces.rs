//! How small are the traces of each map, and how fast are they read?
//!
//! The yardstick of size is a list of addresses, eight bytes each, by zstd -3; that of speed is the walk of the kd-tree's heap,
//! whose nodes cost two bits each. Blocks are those of `pm-gather`, 4,096 searches; reading is decompressing, replaying and the
//! digest. Rounds are interleaved and medians of processor time compared, so that a busy machine slows all alike.
//!
//! `cargo bench -p pm-programs --bench traces [-- QUERIES [ROUNDS [PHOTONS]]]`.
#![allow(clippy::print_stdout)]

mod common;
mod room;

use common::{cpu_time, median, morton};
use pm_formats::trace::{Access, BlockEncoder, Region, TraceSink, decode_searches};
use pm_formats::{Block, BlockMeta};
use pm_maps::{AnyMap, Nearest, Search, SearchReads, Setting, structures};
use room::Room;
use std::hint::black_box;

const K: usize = 100;
const SEARCHES_OF_BLOCK: usize = 4096;
const MAPS: [&str; 6] = ["kd", "bucket-kd", "vvh", "kdb", "wide", "block-hash"];

fn main() {
    let Room { queries, rounds, photons, scattered } = Room::asked_for();
    let count = photons.len();
    let mut sorted = scattered.clone();
    sorted.sort_by_key(morton);
    let maps = MAPS.map(|word| {
        let chosen = structures().choose(word).expect("a map");
        let built = chosen.entry.build(Setting { values: &chosen.values, photons: &photons, k: K });
        (word, built.expect("a map of plain photons"))
    });
    for (name, points) in [("scattered", &scattered), ("cell by cell", &sorted)] {
        println!(
            "{name}: {queries} queries, {K} of {count} photons; bits a read, those of raw addresses, reads/s, ratio"
        );
        let traces: Vec<Trace> = maps.iter().map(|(_, map)| Trace::of(&**map, points)).collect();
        let mut times = vec![vec![]; traces.len()];
        for _ in 0..rounds {
            for (trace, times) in traces.iter().zip(&mut times) {
                let start = cpu_time();
                assert_eq!(black_box(trace.read()), trace.addresses.0, "all reads come back");
                times.push((cpu_time() - start).as_secs_f64());
            }
        }
        let rates: Vec<f64> =
            traces.iter().zip(times).map(|(trace, times)| trace.addresses.0.reads as f64 / median(times)).collect();
        for (((word, _), trace), rate) in maps.iter().zip(&traces).zip(&rates) {
            let reads = trace.addresses.0.reads as f64;
            let bits = |bytes: usize| 8.0 * bytes as f64 / reads;
            let stored = trace.blocks.iter().map(Block::stored_len).sum();
            let (own, raw) = (bits(stored), bits(trace.addresses.1));
            println!("  {word:12}{own:8.2}{raw:8.2}{:8.1} M{:6.2}", rate / 1e6, rate / rates[0]);
        }
    }
}

/// The searches of a map as a trace, and what their addresses are as a list.
struct Trace {
    regions: Vec<Region>,
    blocks: Vec<Block>,
    /// Their sum, and the bytes they take by zstd -3.
    addresses: (Sum, usize),
}

impl Trace {
    fn of(map: &dyn AnyMap, points: &[[f32; 3]]) -> Self {
        let regions = map.regions(false);
        let (mut reads, mut found) = (SearchReads::default(), Nearest::new(K, f32::INFINITY));
        let (mut blocks, mut sum, mut raw) = (vec![], Sum::default(), vec![]);
        for points in points.chunks(SEARCHES_OF_BLOCK) {
            let mut encoder = BlockEncoder::new(&regions);
            for &point in points {
                reads.clear();
                Search::new(K, f32::INFINITY).run(map, point, &mut found, &mut reads);
                encoder.begin(&[0]);
                for (region, records) in reads.runs() {
                    encoder.records(region, records);
                    let of = &regions[usize::from(region)];
                    for &record in records {
                        let read = Access::read(region, u64::from(record) * u64::from(of.record_size), of.record_size);
                        sum.access(read);
                        raw.extend_from_slice(&(of.base + read.offset).to_le_bytes());
                    }
                }
                encoder.end();
            }
            blocks.push(encoder.finish(BlockMeta::default()).expect("a block's worth").0);
        }
        let raw = zstd::bulk::compress(&raw, 3).expect("memory").len();
        Self { regions, blocks, addresses: (sum, raw) }
    }

    fn read(&self) -> Sum {
        let mut sum = Sum::default();
        for block in &self.blocks {
            decode_searches(block, &self.regions, &mut sum).expect("a block that was written");
        }
        sum
    }
}

/// Number of reads, and the sum of where they are: that it is looked at makes sure that they are decoded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Sum {
    reads: u64,
    places: u64,
}

impl TraceSink for Sum {
    #[inline]
    fn access(&mut self, access: Access) {
        self.reads += 1;
        self.places = self.places.wrapping_add(access.offset << 1 | u64::from(access.region));
    }
}
