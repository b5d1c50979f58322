//! Do all structures pass what every one must, and are searches, layouts and builds what they say?

use super::*;
use crate::trial::{Form, cases, photons, query_points, random_points};
use pm_formats::Photon;

/// The map that a line asks for.
pub(super) fn build(line: &str, photons: &[Photon], k: usize) -> Box<dyn AnyMap> {
    Form::new(&structures(), line).unwrap().build(photons, k).unwrap()
}

#[test]
fn every_exact_map_finds_what_brute_force_finds() {
    trial::neighbours(&structures()).unwrap();
}

#[test]
fn reads_lie_within_their_regions_and_are_told_apart() {
    trial::reads(&structures()).unwrap();
    let photons = photons(random_points(3000, |[x, y, _]| [x, 0.0, y]));
    for form in trial::forms(&structures()).unwrap() {
        let (map, mut reads) = (form.build(&photons, 50).unwrap(), SearchReads::default());
        for photon in photons.iter().step_by(300) {
            map.nearest_read(photon.position, &mut Nearest::new(50, f32::INFINITY), &mut reads);
        }
        assert!(!map.is_exact() || reads.photons_examined() >= 500, "{}", form.line);
    }
}

#[test]
fn what_reads_wait_for_is_there_and_stays_the_same() {
    trial::waits(&structures()).unwrap();
}

#[test]
fn nobody_changes_a_search_by_watching_it() {
    trial::observers(&structures()).unwrap();
}

#[test]
fn where_a_search_starts_changes_reads_and_not_neighbours() {
    trial::hints(&structures()).unwrap();
}

#[test]
fn exact_structures_are_those_that_say_so() {
    let exact: Vec<_> = structures().iter().filter(|it| it.is_exact()).map(|it| it.word()).collect();
    assert_eq!(exact, ["kd", "bucket-kd", "wide", "vvh", "kdb", "grid", "reverse", "treelets", "brute"]);
    // And where nothing is lost, a grid of fixed cells.
    let photons = photons(random_points(3000, |[x, y, _]| [x, 0.0, y]));
    let is_exact = |line| build(line, &photons, 10).is_exact();
    assert_eq!(["grid-fixed --slots 4000", "grid-fixed --slots 1", "block-hash"].map(is_exact), [true, false, false]);
}

#[test]
fn carrying_saves_reads_where_queries_are_neighbours() {
    let positions = random_points(20_000, |[x, y, _]| [x, 0.0, y]);
    let photons = photons(positions.iter().copied());
    let map = build("bucket-kd", &photons, 100);
    let search = Search::new(100, f32::INFINITY).fit_start(&*map, &photons);
    let (mut found, mut carry) = (Nearest::new(100, 0.0), Carry::default());
    let (mut plain, mut carried) = (0u64, 0u64);
    for step in 0..1000u16 {
        let point = [0.3 + f32::from(step) * 1e-4, 0.0, 0.5];
        search.run(&*map, point, &mut found, &mut plain);
        carry.run(&search, &*map, point, &mut found, &mut carried);
    }
    assert!(carried * 10 < plain * 9, "{carried} {plain}");
}

#[test]
fn padded_records_lie_in_lines() {
    let photons = photons(random_points(100, |p| p));
    for (line, bytes) in [(32, 3200), (128, 17 * 128), (256, 9 * 256)] {
        let map = build(&format!("kd --pad --line {line}"), &photons, 10);
        assert_eq!((map.padding(), map.regions(false)[0].size), (Some(line), bytes));
    }
    assert_eq!(build("kd", &photons, 10).padding(), None);
}

#[test]
fn a_fitted_start_saves_reads() {
    let positions = random_points(20_000, |[x, y, _]| [x, 0.0, y]);
    let photons = photons(positions.iter().copied());
    let tree = KdTree::build(&photons, Layout::Heap).unwrap();
    let (plain, fitted) = (Search::new(100, f32::INFINITY), Search::new(100, f32::INFINITY).fit_start(&tree, &photons));
    let mut found = Nearest::new(100, 0.0);
    let (mut plain_reads, mut fitted_reads) = (0u64, 0u64);
    for &point in positions.iter().step_by(100) {
        plain.run(&tree, point, &mut found, &mut plain_reads);
        fitted.run(&tree, point, &mut found, &mut fitted_reads);
    }
    assert!(fitted_reads < plain_reads, "{fitted_reads} {plain_reads}");
}

#[test]
fn each_attempt_is_one_walk_from_the_root() {
    let photons = photons(random_points(300, |p| p));
    let tree = KdTree::build(&photons, Layout::Heap).unwrap();
    let search = Search { start: 1e-3, ..Search::new(50, f32::INFINITY) };
    let mut reads = SearchReads::default();
    let attempts = search.run(&tree, [0.5; 3], &mut Nearest::new(50, 0.0), &mut reads);
    let roots = reads.runs().flat_map(|(_, records)| records).filter(|&&record| record == 0).count();
    assert!(attempts > 3 && roots == attempts as usize, "{attempts} attempts, {roots} roots");
}

#[test]
fn layouts_change_records_and_nothing_else() {
    let photons = photons(random_points(1000, |p| p));
    layouts_agree([Layout::Heap, Layout::Preorder].map(|layout| KdTree::build(&photons, layout).unwrap()));
    layouts_agree([Layout::Heap, Layout::Veb].map(|layout| KdTree::build(&photons, layout).unwrap()));
}

fn layouts_agree(trees: [KdTree; 2]) {
    let mut pairs: Vec<std::collections::BTreeMap<u32, u32>> = vec![];
    for point in query_points(&[[0.5; 3]]) {
        let runs = trees.each_ref().map(|tree| {
            let (mut found, mut reads) = (Nearest::new(10, f32::INFINITY), SearchReads::default());
            tree.nearest(point, &mut found, &mut reads);
            (found.sorted(), reads.runs().flat_map(|(_, records)| records.to_vec()).collect::<Vec<_>>())
        });
        assert_eq!(runs[0].0, runs[1].0);
        // The same walk, each node always the same other record.
        pairs.push(runs[0].1.iter().copied().zip(runs[1].1.iter().copied()).collect());
        assert_eq!(runs[0].1.len(), runs[1].1.len());
    }
    let mut all = std::collections::BTreeMap::new();
    for (heap, preorder) in pairs.into_iter().flatten() {
        assert_eq!(*all.entry(heap).or_insert(preorder), preorder);
    }
    assert_eq!(all.values().collect::<std::collections::BTreeSet<_>>().len(), all.len());
}

#[test]
fn every_photon_is_one_node_and_the_left_is_never_right() {
    let photons = photons(cases().into_iter().flat_map(|(_, positions)| positions));
    let tree = KdTree::build(&photons, Layout::Heap).unwrap();
    let nodes: Vec<_> = tree.nodes().collect();
    let ids: std::collections::BTreeSet<_> = nodes.iter().map(|&(_, id)| id).collect();
    assert_eq!(ids.len(), photons.len());
    for i in 2..=nodes.len() {
        // Each node against all its ancestors: the side it is on is the side its coordinate says.
        let mut below = i;
        while below > 1 {
            let (axis, parent) = nodes[below / 2 - 1];
            let coordinate = |id: u32| photons[id as usize].position[axis];
            let (own, split) = (coordinate(nodes[i - 1].1), coordinate(parent));
            assert!(if below.is_multiple_of(2) { own <= split } else { own >= split });
            below /= 2;
        }
    }
}

#[test]
fn a_million_identical_photons_build_and_search() {
    let photons = photons(vec![[0.5; 3]; 1_000_000]);
    let words = structures().words().into_iter().map(str::to_owned);
    for options in words.chain(["kd --layout veb".into()]) {
        let start = std::time::Instant::now();
        let map = build(&options, &photons, 100);
        let mut found = Nearest::new(100, f32::INFINITY);
        map.nearest_blind([0.5, 0.5, 0.4], &mut found);
        if map.is_exact() {
            let expected: Vec<_> = (0..100).map(|id| (found.bound(), id)).collect();
            assert_eq!(found.sorted(), expected, "{options}");
        }
        // A quadratic build would take hours.
        assert!(start.elapsed().as_secs() < 60, "{options}: {:?}", start.elapsed());
    }
}

#[test]
fn coordinates_that_cannot_be_compared_are_refused() {
    trial::refusals(&structures()).unwrap();
    let mut list = photons(random_points(10, |p| p));
    list[7].position[1] = f32::NAN;
    assert_eq!(KdTree::build(&list, Layout::Heap).err(), Some(BuildError::Coordinate(7)));
    list[3].position[0] = 1e19;
    assert_eq!(BruteForce::build(&list).err(), Some(BuildError::Coordinate(3)));
}

#[test]
fn lines_without_room_are_refused() {
    let list = photons(random_points(10, |p| p));
    let small = |built: Result<(), BuildError>, line, least| assert_eq!(built, Err(BuildError::Line { line, least }));
    small(KdTree::build(&list, Layout::Heap).and_then(|tree| tree.padded(16)).map(|_| ()), 16, 20);
    small(BucketKdTree::build(&list, Layout::Heap, 19).map(|_| ()), 19, 20);
    small(VvhTree::build(&list, 10, 0).map(|_| ()), 0, 20);
    let pages = |line, pages| KdbTree::build(&list, KdbOptions { line, pages, fill: 1.0 }).map(|_| ());
    small(pages(27, PageForm::Compact), 27, 28);
    small(pages(63, PageForm::Boxes), 63, 64);
    assert_eq!([pages(28, PageForm::Compact), pages(64, PageForm::Boxes)], [Ok(()), Ok(())]);
}

#[test]
fn the_documentation_lists_every_structure() {
    let readme = include_str!("../README.md");
    assert!(readme.contains(&structures().table()), "tools/maps/README.md should hold:\n{}", structures().table());
}
