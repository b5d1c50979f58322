//! Does what is kept come back, whatever the walks, and is what is damaged refused?

use super::*;
use crate::Tally;
use crate::container::{Block, BlockMeta, Header};
use crate::trace::{Access, BlockEncoder, Coding, TraceReader, TraceSink, TraceWriter, lay_out};
use proptest::prelude::*;

/// A tree, and beside it a table whose reads are no walks.
fn regions(nodes: u32) -> Vec<Region> {
    lay_out([
        ("tree".to_owned(), u64::from(nodes) * 20, 20, Coding::HeapWalk { nodes, reread: true }),
        ("table".to_owned(), 4096, 16, Coding::Records),
    ])
}

/// A walk that goes to this leaf first, and wherever else the choices say.
fn walk(nodes: u32, leaf: u32, choices: &mut impl FnMut() -> bool) -> Vec<u32> {
    fn visit(node: u32, nodes: u32, leaf: u32, choices: &mut impl FnMut() -> bool, visited: &mut Vec<u32>) {
        visited.push(node - 1);
        let down = |child: u32| (1..32).any(|levels| leaf >> levels == child) || leaf == child;
        let first = 2 * node + u32::from(down(2 * node + 1));
        for (child, is_first) in [(first, true), (first ^ 1, false)] {
            // A node with one child may leave it alone.
            let must = is_first && 2 * node < nodes;
            if child <= nodes && (must || choices()) {
                visit(child, nodes, leaf, choices, visited);
            }
        }
    }
    let mut visited = vec![];
    visit(1, nodes, leaf, choices, &mut visited);
    visited
}

/// Chances of one in four, by a seed.
fn chances(mut state: u64) -> impl FnMut() -> bool {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state >> 62 == 0
    }
}

/// A block of searches that come to these leaves first; each third one walks twice, each fifth one reads the table.
fn block(regions: &[Region], nodes: u32, leaves: &[u32], meta: BlockMeta) -> (Block, Tally) {
    let mut encoder = BlockEncoder::new(regions);
    for (at, &leaf) in (0u32..).zip(leaves) {
        encoder.begin(&[at / 2, at]);
        // Searches of one leaf walk alike.
        for again in 0..if at % 3 == 0 { 2 } else { 1 } {
            encoder.records(0, &walk(nodes, leaf, &mut chances(u64::from(leaf) * 7 + again)));
        }
        if at % 5 == 0 {
            encoder.records(1, &[at % 256, 3]);
        }
        encoder.end();
    }
    encoder.finish(meta).unwrap()
}

/// Leaves of a tree of so many nodes, in no order.
fn scattered(nodes: u32, searches: u32) -> Vec<u32> {
    (0..searches).map(|at| nodes / 2 + 1 + at.wrapping_mul(0x9e37_79b9) % nodes.div_ceil(2)).collect()
}

/// The byte that says in which order walks were coded.
fn kind(packed: &[u8]) -> u8 {
    packed[4 + u32::from_le_bytes(packed[..4].try_into().unwrap()) as usize]
}

proptest! {
    #[test]
    fn whatever_is_packed_comes_back(nodes in 1u32..300, leaves in prop::collection::vec(0u32..300, 0..60)) {
        let regions = regions(nodes);
        let leaves: Vec<u32> = leaves.iter().map(|leaf| nodes / 2 + 1 + leaf % nodes.div_ceil(2)).collect();
        let searches = leaves.len() as u32;
        let payload = block(&regions, nodes, &leaves, BlockMeta::default()).0.decode().unwrap();
        match pack(&payload, searches, &regions) {
            Some(packed) => {
                prop_assert!(unpack(&packed, payload.len(), searches, &regions).as_ref() == Some(&payload));
                for wrong in [payload.len() - 1, payload.len() + 1] {
                    prop_assert_eq!(unpack(&packed, wrong, searches, &regions), None);
                }
                prop_assert_eq!(unpack(&packed, payload.len(), searches + 1, &regions), None);
            }
            // Without a walk there is nothing to code by walks.
            None => prop_assert_eq!(searches, 0),
        }
    }
}

#[test]
fn damage_is_harmless() {
    let regions = regions(500);
    for sorted in [false, true] {
        let mut leaves = scattered(500, 3000);
        if !sorted {
            leaves.sort_unstable();
        }
        let payload = block(&regions, 500, &leaves, BlockMeta::default()).0.decode().unwrap();
        let packed = pack(&payload, 3000, &regions).unwrap();
        assert_eq!(kind(&packed), if sorted { SORTED } else { AS_THEY_STAND });
        for at in (0..packed.len()).step_by(37).chain(packed.len() - 20..packed.len()) {
            let mut damaged = packed.clone();
            damaged[at] ^= 1 << (at % 8);
            // Checksums of blocks see what is left of it.
            if let Some(other) = unpack(&damaged, payload.len(), 3000, &regions) {
                assert_eq!(other.len(), payload.len());
            }
            assert_eq!(unpack(&packed[..at], payload.len(), 3000, &regions), None);
        }
        let behind = [&packed[..], &[0; 4]].concat();
        assert_eq!(unpack(&behind, payload.len(), 3000, &regions), None);
    }
}

#[test]
fn a_search_twice_in_the_order_is_refused() {
    let regions = regions(500);
    let payload = block(&regions, 500, &scattered(500, 3000), BlockMeta::default()).0.decode().unwrap();
    let packed = pack(&payload, 3000, &regions).unwrap();
    assert_eq!(kind(&packed), SORTED);
    let places = 5 + u32::from_le_bytes(packed[..4].try_into().unwrap()) as usize;
    for (place, search) in [(7, [packed[places], packed[places + 1]]), (9, 3000u16.to_le_bytes())] {
        let mut wrong = packed.clone();
        wrong[places + 2 * place..places + 2 * place + 2].copy_from_slice(&search);
        assert_eq!(unpack(&wrong, payload.len(), 3000, &regions), None);
    }
}

#[test]
fn bits_that_fill_a_byte_are_kept_by_zstd_if_they_are_set() {
    let regions = regions(500);
    let leaves = scattered(500, 3000);
    let mut payload = block(&regions, 500, &leaves, BlockMeta::default()).0.decode().unwrap();
    assert!(pack(&payload, 3000, &regions).is_some());
    let planes = split(&payload).unwrap();
    let walks = Walks::of(planes[HEADS], 3000, &regions).unwrap();
    let second = begins(planes[WALKS], &walks).unwrap()[1].0;
    // The last bit before the second search's walks: some search has one that fills.
    let begin = 12 + planes[0].len() + planes[1].len();
    payload[begin + second - 1] |= 0x80;
    assert_eq!(pack(&payload, 3000, &regions), None);
}

#[test]
fn trees_that_are_too_large_or_several_are_left_to_zstd() {
    let walked = |regions: &[Region], both: bool| {
        let mut encoder = BlockEncoder::new(regions);
        encoder.begin(&[]);
        encoder.records(0, &[0, 1]);
        if both {
            encoder.records(1, &[0, 1]);
        }
        encoder.end();
        let payload = encoder.finish(BlockMeta::default()).unwrap().0.decode().unwrap();
        pack(&payload, 1, regions).is_some()
    };
    let tree = |nodes| ("tree".to_owned(), u64::from(nodes) * 20, 20, Coding::HeapWalk { nodes, reread: false });
    assert!(walked(&lay_out([tree(2)]), false));
    assert!(walked(&lay_out([tree(2), tree(2)]), false));
    assert!(!walked(&lay_out([tree(2), tree(2)]), true));
    let large = |nodes| segments::has_tree(&lay_out([tree(nodes)]));
    assert!(large(memory::MOST_NODES) && !large(memory::MOST_NODES + 1));
}

#[derive(Default, PartialEq)]
struct Collect(Vec<(u64, bool)>, Vec<Vec<u32>>, Vec<Access>);

impl TraceSink for Collect {
    fn block(&mut self, batch: u64, warm_up: bool) {
        if self.0.last() != Some(&(batch, warm_up)) {
            self.0.push((batch, warm_up));
        }
    }
    fn search(&mut self, destinations: &[u32]) {
        self.1.push(destinations.to_vec());
    }
    fn access(&mut self, access: Access) {
        self.2.push(access);
    }
}

#[test]
fn an_archive_has_the_blocks_of_a_batch_in_one_and_the_same_searches() {
    let regions = regions(5000);
    let header = Header { regions: regions.clone(), ..Header::empty() };
    let mut writer = TraceWriter::new(vec![], &header).unwrap();
    let leaves = scattered(5000, 9000);
    let metas = [(0, true), (0, false), (0, false), (0, false), (1, false), (2, false)];
    for ((batch, warm_up), leaves) in metas.into_iter().zip(leaves.chunks(1500)) {
        let (block, tally) = block(&regions, 5000, leaves, BlockMeta { batch, warm_up, ..BlockMeta::default() });
        writer.write(&block, tally).unwrap();
    }
    let plain = writer.finish(vec![]).unwrap();
    let archive = |bytes: &[u8]| {
        let mut reader = TraceReader::new(bytes).unwrap();
        let mut writer = TraceWriter::new(vec![], reader.header()).unwrap();
        let mut blocks = vec![];
        while let Some((block, tally)) = reader.next_archived().unwrap() {
            blocks.push((block.meta.records, block.walks().is_some()));
            writer.write(&block, tally).unwrap();
        }
        (writer.finish(reader.end().unwrap().stages.clone()).unwrap(), blocks)
    };
    let all = |bytes: &[u8]| {
        let mut reader = TraceReader::new(bytes).unwrap();
        let mut found = Collect::default();
        while reader.replay_block(&mut found).unwrap().is_some() {}
        (found, reader.end().unwrap().clone())
    };
    let (kept, blocks) = archive(&plain);
    assert_eq!(blocks, [(1500, false), (4500, true), (1500, false), (1500, false)], "whichever is smaller");
    assert!(kept.len() < plain.len(), "{} {}", kept.len(), plain.len());
    assert!(all(&kept) == all(&plain));
    assert!(archive(&kept).0 == kept, "an archive is one");
}
