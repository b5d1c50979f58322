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
