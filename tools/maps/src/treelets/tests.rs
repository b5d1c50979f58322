//! Do searches that wait find what they would by themselves, in pieces that fit, and are they charged for what they carry?

use super::*;
use crate::trial::{batch_finds_what_each_query_finds, cases, photons, random_points};
use crate::{Search, SearchReads};

const OPTIONS: TreeletOptions =
    TreeletOptions { treelet: 300, batch: 4096, waiting: Waiting::Memory, line: 128, k: 10 };

/// Region and record of each read of a batch, with `k` photons sought.
fn reads(map: &Treelets, points: &[[f32; 3]], k: usize) -> Vec<(u16, u32)> {
    let mut held: Vec<Nearest> = points.iter().map(|_| Nearest::new(k, f32::INFINITY)).collect();
    let mut reads = SearchReads::default();
    map.nearest_of_all(points, &mut held.iter_mut().collect::<Vec<_>>(), &mut reads);
    reads.runs().flat_map(|(region, records)| records.iter().map(move |&record| (region, record))).collect()
}

#[test]
fn a_batch_finds_what_looking_at_all_photons_finds_for_each_query() {
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        for treelet in [20, 60, 300, 1 << 20] {
            let map = Treelets::build(&photons, TreeletOptions { treelet, ..OPTIONS }).unwrap();
            for search in [Search::new(10, f32::INFINITY), Search { start: 0.01, ..Search::new(10, 0.3) }] {
                batch_finds_what_each_query_finds(&format!("{name}, {treelet}"), &map, &positions, &search);
            }
        }
    }
}

#[test]
fn a_treelet_is_connected_lies_in_a_row_and_is_as_large_as_it_may_be() {
    for (count, most) in
        [(1, 1), (1, 7), (2, 1), (1000, 1), (1000, 2), (1000, 15), (1023, 31), (1024, 100), (5000, 1 << 14)]
    {
        let cut = Cut::new(count, most);
        let records = cut.records(count);
        let mut members = std::collections::BTreeMap::<u32, Vec<u32>>::new();
        for node in 1..=count as u32 {
            // The uppermost node is found by going up while the treelet is the same.
            let mut top = node;
            while top > 1 && cut.treelet(top / 2) == cut.treelet(node) {
                top /= 2;
            }
            assert_eq!(top, cut.treelet(node), "{count} {most} {node}");
            members.entry(top).or_default().push(records[node as usize - 1]);
        }
        assert_eq!(members.len() as u64, cut.treelets(count));
        let largest = members.values().map(Vec::len).max().unwrap();
        assert!(largest <= most && largest * 4 > most.min(count), "{count} {most}: {largest}");
        // 31 nodes are five levels, and ten levels two times five.
        assert!((count, most) != (1023, 31) || largest == 31 && members.len() == 33);
        // They follow each other without gaps.
        let all: Vec<u32> = members.into_values().flatten().collect();
        assert!(all.iter().copied().eq(0..count as u32), "{count} {most}");
    }
}

#[test]
fn waiting_changes_when_a_node_is_read_and_not_whether() {
    let photons = photons(random_points(3000, |p| p));
    let points = random_points(200, |[x, y, z]| [z, x, y]);
    for treelet in [20, 300, 5000] {
        let map = Treelets::build(&photons, TreeletOptions { treelet, waiting: Waiting::Chip, ..OPTIONS }).unwrap();
        let mut together = reads(&map, &points, 10);
        let mut alone: Vec<_> = points.iter().flat_map(|&point| reads(&map, &[point], 10)).collect();
        let in_turn = alone.clone();
        assert_ne!(together, in_turn, "{treelet}");
        together.sort_unstable();
        alone.sort_unstable();
        assert_eq!(together, alone, "{treelet}");
    }
}

#[test]
fn who_goes_the_same_way_goes_together() {
    // Catches: a search that goes on alone where others wait, as without queues.
    let photons = photons(random_points(3000, |p| p));
    let map = Treelets::build(&photons, TreeletOptions { waiting: Waiting::Chip, ..OPTIONS }).unwrap();
    let mut node_of = vec![0; photons.len()];
    (1..).zip(&map.records).for_each(|(node, &record)| node_of[record as usize] = node);
    let visits = |copies: usize| {
        let reads = reads(&map, &vec![[0.3, 0.6, 0.4]; copies], 10);
        let mut treelets: Vec<u32> =
            reads.iter().map(|&(_, record)| map.cut.treelet(node_of[record as usize])).collect();
        treelets.dedup();
        treelets
    };
    assert!(visits(1).len() > 4, "{:?}", visits(1));
    assert_eq!(visits(100), visits(1));
}

#[test]
fn a_search_that_waited_is_read_with_what_it_has() {
    // Seven photons on a line, three levels, each node a treelet; all photons are wanted, from the left: the search goes down on the
    // left and comes back, and waits before each node but the first.
    let photons = photons((0..7u8).map(|x| [f32::from(x), 0.0, 0.0]));
    let map = Treelets::build(&photons, TreeletOptions { treelet: 20, line: 32, k: 7, ..OPTIONS }).unwrap();
    let read = reads(&map, &[[-1.0, 0.0, 0.0]], 7);
    // Before it candidates: 1 to 6. Open: 2, 2 and then one less by each leaf, as a walk of a complete tree has them.
    let open = [2, 3, 2, 1, 2, 1];
    let lines = (1..7).zip(open).map(|(found, open): (usize, usize)| (48 + 8 * (found + open)).div_ceil(32)).sum();
    assert_eq!(read.iter().filter(|read| read.0 == WAITING).count(), lines);
    assert_eq!(read.iter().filter(|read| read.0 == NODES).count(), 7);
    // On chip nothing is read of it: 48 bytes, 7 candidates and 4 open nodes.
    let chip = Treelets::build(&photons, TreeletOptions { waiting: Waiting::Chip, k: 7, batch: 5, ..OPTIONS }).unwrap();
    assert_eq!((chip.bytes_on_chip(), chip.regions(false).len()), (5 * (48 + 56 + 32), 1));
}

#[test]
fn the_longest_queue_is_next() {
    let mut queues = Queues::default();
    for (treelet, search) in [(5, 0), (3, 1), (9, 2), (9, 3), (3, 4), (2, 5)] {
        queues.push(treelet, search);
    }
    let all: Vec<_> = std::iter::from_fn(|| queues.pop()).collect();
    assert_eq!(all, [(3, vec![1, 4]), (9, vec![2, 3]), (2, vec![5]), (5, vec![0])]);
}
