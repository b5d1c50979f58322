//! Do reads of regions that are coded together come back, whatever they are, and is nothing else taken for them?

use crate::container::{Block, BlockMeta, Header};
use crate::region::{Coding, MAX_IN_TURNS, Region, check_regions, lay_out};
use crate::trace::{Access, AccessKind, BlockEncoder, TraceSink, TraceWriter, Waits, decode_searches};
use proptest::prelude::*;

#[derive(Default)]
struct Collect(Vec<Vec<Access>>);

impl TraceSink for Collect {
    fn search(&mut self, _: &[u32]) {
        self.0.push(vec![]);
    }
    fn access(&mut self, access: Access) {
        self.0.last_mut().unwrap().push(access);
    }
}

/// Bytes of the records, region by region.
const SIZES: [u32; 6] = [20, 8, 128, 64, 4, 3];

/// A heap, a tree of 50 leaves with room for more nodes than it has, and three regions in turns.
fn regions() -> Vec<Region> {
    let codings = [
        Coding::HeapWalk { nodes: 40, reread: false },
        Coding::LeavesApart { leaves: 50 },
        Coding::Records,
        Coding::InTurns,
        Coding::InTurns,
        Coding::InTurns,
    ];
    let region = |(size, coding)| (String::new(), 1 << 20, size, coding);
    lay_out(SIZES.into_iter().zip(codings).map(region))
}

/// The tree's walk that goes where the bits say.
fn walk(mut bits: u64) -> Vec<Access> {
    let mut reads = vec![];
    let mut later = vec![1u32];
    while let Some(node) = later.pop() {
        let leaf = node >= 50;
        let (record, region) = if leaf { (node - 50, 2) } else { (node - 1, 1) };
        reads.push(read(region, record));
        if !leaf {
            let (first, both) = (2 * node + (bits & 1) as u32, bits & 2 == 2);
            bits = bits.rotate_right(2);
            later.extend(both.then_some(first ^ 1));
            later.push(first);
        }
    }
    reads
}

fn read(region: u16, record: u32) -> Access {
    let size = SIZES[usize::from(region)];
    Access::read(region, u64::from(record) * u64::from(size), size)
}

fn some_accesses() -> impl Strategy<Value = Vec<Access>> {
    let one = |access| vec![access];
    prop_oneof![
        (0u16..6, 0u32..120).prop_map(move |(region, record)| one(read(region, record))),
        (3u16..6, 0u32..8000).prop_map(move |(region, record)| one(read(region, record))),
        any::<u64>().prop_map(walk),
        (any::<u64>(), 0usize..9).prop_map(|(bits, len)| walk(bits).into_iter().take(len).collect()),
        (0u16..6, 0u64..9000, 1u32..40)
            .prop_map(move |(region, offset, len)| { one(Access { kind: AccessKind::Write, region, len, offset }) }),
    ]
}

fn encoded(regions: &[Region], searches: &[Vec<Access>]) -> (Block, crate::digest::Tally) {
    let mut encoder = BlockEncoder::new(regions);
    for accesses in searches {
        encoder.begin(&[]);
        accesses.iter().for_each(|&access| encoder.access(access));
        encoder.end();
    }
    encoder.finish(BlockMeta::default()).unwrap()
}

fn decoded(regions: &[Region], block: &Block) -> Option<(Vec<Vec<Access>>, crate::digest::Tally)> {
    let mut found = Collect::default();
    decode_searches(block, regions, &mut found).map(|tally| (found.0, tally))
}

proptest! {
    #[test]
    fn any_reads_come_back(
        searches in prop::collection::vec(prop::collection::vec(some_accesses(), 0..12), 0..8)
    ) {
        let searches: Vec<Vec<Access>> = searches.into_iter().map(|parts| parts.concat()).collect();
        let regions = regions();
        let (block, tally) = encoded(&regions, &searches);
        prop_assert_eq!(decoded(&regions, &block), Some((searches.clone(), tally)));
        // The same as where each is spelled out.
        let plain: Vec<Region> = regions.iter().map(|it| Region { coding: Coding::Records, ..it.clone() }).collect();
        let (block, tally) = encoded(&plain, &searches);
        prop_assert_eq!(decoded(&plain, &block), Some((searches.clone(), tally)));
    }

    #[test]
    fn any_bytes_are_searches_within_the_regions_or_none(
        heads in prop::collection::vec(0u8..14, 0..24), walks in prop::collection::vec(any::<u8>(), 0..12),
        others in prop::collection::vec(any::<u8>(), 0..40)
    ) {
        let mut waiting = regions();
        waiting.iter_mut().filter(|it| it.is_in_turns()).for_each(|it| it.coding = Coding::Waiting);
        for regions in [regions(), waiting] {
            let lens = [heads.len(), 1, walks.len()].map(|len| (len as u32).to_le_bytes()).concat();
            let payload = [&lens[..], &heads, &[0], &walks, &others].concat();
            let block = Block::encode(BlockMeta { records: 1, ..BlockMeta::default() }, &payload, 3).unwrap();
            for access in decoded(&regions, &block).map_or(vec![], |(found, _)| found.concat()) {
                prop_assert!(regions[usize::from(access.region)].holds(access.offset, access.len));
            }
        }
    }
}

/// Hears what reads wait for.
#[derive(Default)]
struct Told(Vec<(u16, u64, Waits)>, Waits);

impl TraceSink for Told {
    fn waits(&mut self, waits: Waits) {
        self.1 = waits;
    }
    fn access(&mut self, access: Access) {
        self.0.push((access.region, access.offset / 16, std::mem::take(&mut self.1)));
    }
}

/// A search's reads of two regions that say what they wait for, as bytes of its others.
fn waiting(count: u8, others: &[u8]) -> Option<Vec<(u16, u64, Waits)>> {
    let regions = lay_out([16, 16].map(|size| (String::new(), 1600, size, Coding::Waiting)));
    let lens = [3u32, 1, 0].map(u32::to_le_bytes).concat();
    let payload = [&lens[..], &[1, 1, count, 0], others].concat();
    let block = Block::encode(BlockMeta { records: 1, ..BlockMeta::default() }, &payload, 3).unwrap();
    let mut told = Told::default();
    decode_searches(&block, &regions, &mut told).map(|_| told.0)
}

#[test]
fn what_reads_wait_for_comes_back() {
    let regions = lay_out([16, 16].map(|size| (String::new(), 1600, size, Coding::Waiting)));
    let mut encoder = BlockEncoder::new(&regions);
    encoder.begin(&[0]);
    encoder.waiting_records(0, &[9, 4], &[Waits::NOTHING, Waits::last_above(1)]);
    encoder.waiting_records(1, &[7], &[Waits::all_above(2)]);
    encoder.records(1, &[8]);
    encoder.access(Access { kind: AccessKind::Write, region: 0, len: 3, offset: 32 });
    encoder.waiting_records(0, &[9], &[Waits::ALL_BEFORE]);
    encoder.end();
    let (block, _) = encoder.finish(BlockMeta::default()).unwrap();
    let mut told = Told::default();
    decode_searches(&block, &regions, &mut told).unwrap();
    let expected = [
        (0, 9, Waits::NOTHING),
        (0, 4, Waits::last_above(1)),
        (1, 7, Waits::all_above(2)),
        (1, 8, Waits::NOTHING),
        (0, 2, Waits::NOTHING),
        (0, 9, Waits::ALL_BEFORE),
    ];
    assert_eq!(told.0, expected);
    // By the words of the format: 2 level + a, then the record as in turns.
    assert_eq!(waiting(2, &[0, 9 << 2, 2, 3 << 1 | 1]), None, "record -2");
    assert_eq!(
        waiting(2, &[0, 9 << 2, 3, 6 << 1 | 1]),
        Some(vec![(0, 9, Waits::NOTHING), (1, 3, Waits::all_above(1))])
    );
    assert_eq!(waiting(1, &[2, 0]), None, "there is nothing at level 0");
    assert_eq!(waiting(1, &[1, 0]), Some(vec![(0, 0, Waits::ALL_BEFORE)]));
    assert_eq!(waiting(2, &[0, 0, 6, 0]), None, "there is nothing at level 2");
}

#[test]
fn order_of_searches_is_not_in_the_digest() {
    let regions = regions();
    let searches = [walk(0x35), vec![read(3, 9), read(4, 700), read(3, 8)], vec![read(4, 1)], walk(7)];
    let mut reversed = searches.to_vec();
    reversed.reverse();
    assert_eq!(encoded(&regions, &searches).1, encoded(&regions, &reversed).1);
}

#[test]
fn walks_to_leaves_that_lie_apart_cost_bits() {
    let regions = regions();
    let searches: Vec<Vec<Access>> = (0..100u64).map(|i| walk(i.wrapping_mul(0x9e37_79b9_7f4a_7c15))).collect();
    let (block, _) = encoded(&regions, &searches);
    let reads: usize = searches.iter().map(Vec::len).sum();
    // Two bits an inner node, and the bytes of the searches.
    assert!(8 * block.stored_len() < 2 * reads + 8 * 60 + 8 * 5 * searches.len(), "{} {reads}", block.stored_len());
}

#[test]
fn reads_beyond_a_region_or_of_none_are_refused() {
    let regions = lay_out([8, 16, 32].map(|size| (String::new(), 1000, size, Coding::InTurns)));
    let with = |count: u64, others: &[u8]| {
        let mut heads = vec![1, 1];
        super::super::varint::push(&mut heads, count);
        let lens = [heads.len(), 1, 0].map(|len| (len as u32).to_le_bytes()).concat();
        let payload = [&lens[..], &heads, &[0], others].concat();
        decoded(&regions, &Block::encode(BlockMeta { records: 1, ..BlockMeta::default() }, &payload, 3).unwrap())
            .map(|(found, _)| found[0].iter().map(|read| (read.region, read.offset)).collect::<Vec<_>>())
    };
    // Two bits of rank, then zigzag: record 2 of the second, record 1 of it, record 0 of the third.
    assert_eq!(with(3, &[4 << 2 | 1, 1 << 2 | 1, 2]), Some(vec![(1, 32), (1, 16), (2, 0)]));
    assert_eq!(with(1, &[3]), None, "there is no fourth");
    assert_eq!(with(1, &[1 << 2]), None, "record -1");
    // The last whole record of the first is number 124, as integer 248 << 2.
    assert_eq!(with(1, &[0xe0, 0x07]), Some(vec![(0, 992)]));
    assert_eq!(with(1, &[0xe8, 0x07]), None, "record 125");
    assert_eq!(with(2, &[0]), None, "fewer than said");
    assert_eq!(with(1, &[0, 0]), None, "more than said");
    assert_eq!(with(u64::MAX, &[0; 20]), None);
}

#[test]
fn regions_that_cannot_be_coded_together_are_refused() {
    let check = |regions: Vec<(u64, u32, Coding)>| {
        let regions = lay_out(regions.into_iter().map(|(size, record, coding)| (String::new(), size, record, coding)));
        assert_eq!(
            TraceWriter::new(vec![], &Header { regions: regions.clone(), ..Header::empty() }).is_ok(),
            check_regions(&regions).is_ok()
        );
        check_regions(&regions)
    };
    let apart = |leaves| Coding::LeavesApart { leaves };
    assert_eq!(check(vec![(16, 8, apart(3)), (384, 128, Coding::Records)]), Ok(()));
    assert_eq!(check(vec![(0, 8, apart(1)), (128, 128, Coding::Records)]), Ok(()));
    assert_eq!(check(vec![(0, 8, apart(0)), (0, 128, Coding::Records)]), Ok(()));
    let small = Err("a region is smaller than its nodes");
    assert_eq!(check(vec![(15, 8, apart(3)), (384, 128, Coding::Records)]), small);
    assert_eq!(check(vec![(16, 8, apart(3)), (383, 128, Coding::Records)]), small);
    assert_eq!(check(vec![(16, 0, apart(3)), (384, 128, Coding::Records)]), small);
    assert_eq!(check(vec![(1 << 33, 1, apart(u32::MAX)), (1 << 33, 1, Coding::Records)]), small);
    let alone = Err("a tree has no region of leaves behind it");
    assert_eq!(check(vec![(16, 8, apart(3))]), alone);
    assert_eq!(check(vec![(16, 8, apart(3)), (384, 128, Coding::InTurns)]), alone);
    assert_eq!(check(vec![(16, 8, apart(3)), (384, 8, apart(2)), (384, 128, Coding::Records)]), alone);
    assert_eq!(check(vec![(64, 8, Coding::InTurns); MAX_IN_TURNS]), Ok(()));
    assert_eq!(check(vec![(64, 8, Coding::InTurns); MAX_IN_TURNS + 1]), Err("more than 64 regions are coded in turns"));
    let nothing = Err("a region that is coded in turns has records of no bytes");
    assert_eq!(check(vec![(64, 0, Coding::InTurns)]), nothing);
    let mixed = Err("of the regions that are coded in turns some say what reads wait for and some do not");
    assert_eq!(check(vec![(64, 8, Coding::Waiting); 2]), Ok(()));
    assert_eq!(check(vec![(64, 8, Coding::Waiting), (64, 8, Coding::InTurns)]), mixed);
}
