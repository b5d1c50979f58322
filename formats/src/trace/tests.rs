//! Do searches come back from a block as they were, whatever they touched?

use super::*;
use crate::container::{BlockMeta, Header};
use proptest::prelude::*;

type Search = (Vec<u32>, Vec<Access>);

#[derive(Default)]
struct Collect(Vec<Search>);

impl TraceSink for Collect {
    fn search(&mut self, destinations: &[u32]) {
        self.0.push((destinations.to_vec(), vec![]));
    }
    fn access(&mut self, access: Access) {
        self.0.last_mut().unwrap().1.push(access);
    }
}

fn regions() -> Vec<Region> {
    lay_out([
        ("tree".into(), 20 * 1000, 20, Coding::HeapWalk { nodes: 1000, reread: false }),
        ("table".into(), 1 << 20, 8, Coding::Records),
    ])
}

fn any_access() -> impl Strategy<Value = Access> {
    let kind = prop_oneof![Just(AccessKind::Read), Just(AccessKind::Write), Just(AccessKind::ReadModifyWrite)];
    (kind, 0u16..2, 0u64..900, 1u32..40, any::<bool>()).prop_map(|(kind, region, at, len, whole)| {
        let size = [20, 8][usize::from(region)];
        if whole { Access::read(region, at * u64::from(size), size) } else { Access { kind, region, len, offset: at } }
    })
}

fn encoded(regions: &[Region], searches: &[Search]) -> (crate::container::Block, crate::digest::Tally) {
    let mut encoder = BlockEncoder::new(regions);
    for (pixels, accesses) in searches {
        encoder.begin(pixels);
        accesses.iter().for_each(|&access| encoder.access(access));
        encoder.end();
    }
    encoder.finish(BlockMeta::default()).unwrap()
}

proptest! {
    #[test]
    fn any_searches_come_back(
        searches in prop::collection::vec(
            (prop::collection::vec(any::<u32>(), 0..4), prop::collection::vec(any_access(), 0..20)), 0..12)
    ) {
        let regions = regions();
        let (block, tally) = encoded(&regions, &searches);
        let mut found = Collect::default();
        prop_assert_eq!(decode_searches(&block, &regions, &mut found), Some(tally));
        prop_assert_eq!(&found.0, &searches);
        // The digest is that of a multiset of searches.
        let mut reversed = searches;
        reversed.reverse();
        prop_assert_eq!(encoded(&regions, &reversed).1, tally);
    }
}

proptest! {
    #[test]
    fn any_addresses_come_back(
        searches in prop::collection::vec(
            (prop::collection::vec(any::<u32>(), 0..2),
             prop::collection::vec((0u8..3, prop_oneof![Just(1u32), Just(8), 0u32..5000],
                                    prop_oneof![any::<u64>(), 0u64..64, Just(u64::MAX)]), 0..40)), 0..6)
    ) {
        let regions = [Region::addresses("x")];
        let access = |(kind, len, offset): (u8, u32, u64)| {
            let kind = [AccessKind::Read, AccessKind::Write, AccessKind::ReadModifyWrite][usize::from(kind)];
            Access { kind, region: 0, len: len.min((u64::MAX - offset).min(9000) as u32 + 1), offset }
        };
        let searches: Vec<Search> =
            searches.into_iter().map(|(pixels, of)| (pixels, of.into_iter().map(access).collect())).collect();
        let (block, tally) = encoded(&regions, &searches);
        let mut found = Collect::default();
        prop_assert_eq!(decode_searches(&block, &regions, &mut found), Some(tally));
        prop_assert_eq!(&found.0, &searches);
        // Beyond the last address there is nothing.
        let beyond = Access::read(0, u64::MAX, 2);
        let (block, _) = encoded(&regions, &[(vec![], vec![beyond])]);
        prop_assert_eq!(decode_searches(&block, &regions, &mut Collect::default()), None);
    }
}

#[test]
fn addresses_that_repeat_far_apart_are_found_again() {
    // Half a million addresses of no pattern, twice: the second time costs next to nothing.
    let regions = [Region::addresses("x")];
    let mut encoder = BlockEncoder::new(&regions);
    encoder.begin(&[]);
    for i in (0..500_000u64).chain(0..500_000) {
        encoder.access(Access::read(0, i.wrapping_mul(i).wrapping_mul(0x9e37_79b9_7f4a_7c15), 8));
    }
    encoder.end();
    let (block, _) = encoder.finish(BlockMeta::default()).unwrap();
    assert!(block.stored_len() < 4_100_000, "{}", block.stored_len());
}

#[test]
fn all_addresses_are_a_region_of_their_own() {
    let written = |regions: Vec<Region>| TraceWriter::new(vec![], &Header { regions, ..Header::empty() }).map(|_| ());
    let addresses = Region::addresses("x");
    written(vec![addresses.clone()]).unwrap();
    let table = regions().remove(1);
    for wrong in [
        vec![addresses.clone(), table],
        vec![addresses.clone(), addresses.clone()],
        vec![Region { size: 1 << 40, ..addresses.clone() }],
        vec![Region { base: 4096, ..addresses }],
    ] {
        assert!(written(wrong).unwrap_err().to_string().contains("all addresses"));
    }
}

#[test]
fn walks_cost_bits_and_other_visits_still_come_back() {
    let regions = regions();
    // Root to leaf 512, 513 beside it, and back: then the same a second time, then something that is no walk.
    let walk = [0, 1, 3, 7, 15, 31, 63, 127, 255, 511, 512];
    let mut visits = [walk, walk].concat();
    visits.extend([5, 5, 900]);
    let mut encoder = BlockEncoder::new(&regions);
    encoder.begin(&[3]);
    encoder.records(0, &visits);
    encoder.end();
    let (block, tally) = encoder.finish(BlockMeta::default()).unwrap();
    let mut found = Collect::default();
    assert_eq!(decode_searches(&block, &regions, &mut found), Some(tally));
    let expected: Vec<_> = visits.iter().map(|&i| Access::read(0, u64::from(i) * 20, 20)).collect();
    assert_eq!(found.0, [(vec![3], expected)]);
    assert!(block.stored_len() < 40 + 12 + 8 + 2 + 2 * 3 + 6, "{}", block.stored_len());
}

#[test]
fn regions_that_overlap_or_are_too_small_are_refused() {
    let refused = |change: fn(&mut Vec<Region>)| {
        let mut header = Header::empty();
        header.regions = regions();
        TraceWriter::new(vec![], &header).map(|_| ()).unwrap();
        change(&mut header.regions);
        TraceWriter::new(vec![], &header).map(|_| ()).unwrap_err().to_string()
    };
    assert!(refused(|r| r[1].base = r[0].base).contains("share a page"));
    assert!(refused(|r| r[0].base += 1).contains("page"));
    assert!(refused(|r| r[0].size = 100).contains("smaller"));
    assert!(refused(|r| r[1].size = u64::MAX).contains("address space"));
}

#[test]
fn accesses_longer_than_the_limit_are_neither_written_nor_read() {
    for regions in [vec![Region::addresses("x")], lay_out([("x".to_owned(), 1 << 33, 64, Coding::Records)])] {
        let written = |len: u32| {
            let mut encoder = BlockEncoder::new(&regions);
            encoder.begin(&[]);
            encoder.access(Access { kind: AccessKind::Write, region: 0, len, offset: 5 });
            encoder.end();
            // As a program would write it that knows no limit.
            encoder.forget_lengths();
            encoder.finish(BlockMeta::default()).unwrap().0
        };
        assert!(decode_searches(&written(MAX_ACCESS), &regions, &mut Collect::default()).is_some());
        for len in [MAX_ACCESS + 1, u32::MAX] {
            assert!(decode_searches(&written(len), &regions, &mut Collect::default()).is_none(), "{len}");
            let mut encoder = BlockEncoder::new(&regions);
            encoder.begin(&[]);
            encoder.access(Access::read(0, 0, len));
            encoder.end();
            let said = encoder.finish(BlockMeta::default()).unwrap_err().to_string();
            assert!(said.contains(&format!("an access of {len} bytes; the most is 16777216")), "{said}");
        }
    }
    let long = lay_out([("x".to_owned(), 1 << 33, MAX_ACCESS + 1, Coding::Records)]);
    assert_eq!(crate::region::check_regions(&long), Err("a region has records of more than 2^24 bytes"));
}

#[test]
fn an_archive_holds_the_same_searches_in_fewer_bytes() {
    let regions = lay_out([("x".to_owned(), 1 << 20, 16, Coding::Records)]);
    let mut writer =
        TraceWriter::new(vec![], &crate::Header { regions: regions.clone(), ..crate::Header::empty() }).unwrap();
    for batch in 0..3 {
        let mut encoder = BlockEncoder::new(&regions);
        for search in 0..500u32 {
            encoder.begin(&[search]);
            (0..40).for_each(|i| {
                encoder.access(Access::read(0, u64::from((search * search + i * i * 7) % 60_000) * 16, 16))
            });
            encoder.end();
        }
        let (block, tally) = encoder.finish(BlockMeta { batch, ..BlockMeta::default() }).unwrap();
        writer.write(&block, tally).unwrap();
    }
    let plain = writer.finish(vec![]).unwrap();
    let archive = |bytes: &[u8]| {
        let mut reader = crate::trace::TraceReader::new(bytes).unwrap();
        let mut writer = TraceWriter::new(vec![], reader.header()).unwrap();
        while let Some((block, tally)) = reader.next_archived().unwrap() {
            writer.write(&block, tally).unwrap();
        }
        writer.finish(reader.end().unwrap().stages.clone()).unwrap()
    };
    let all = |bytes: &[u8]| {
        let mut reader = crate::trace::TraceReader::new(bytes).unwrap();
        let mut found = Collect::default();
        while reader.replay_block(&mut found).unwrap().is_some() {}
        (found.0, reader.end().unwrap().clone())
    };
    let kept = archive(&plain);
    assert!(kept.len() < plain.len(), "{} {}", kept.len(), plain.len());
    assert!(all(&kept) == all(&plain));
    assert_eq!(archive(&kept), kept, "an archive is one");
}
