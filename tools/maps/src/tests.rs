//! Do all exact maps find the neighbours that looking at every photon finds, on inputs that break such maps?

use super::*;
use pm_random::Random;

pub(super) fn photons(positions: impl IntoIterator<Item = [f32; 3]>) -> Vec<Photon> {
    let up = [0.0, 1.0, 0.0];
    positions.into_iter().map(|p| Photon::new(p, [1.0; 3], [0.5; 3], up, up).unwrap()).collect()
}

pub(super) fn random_points(n: usize, mut map: impl FnMut([f32; 3]) -> [f32; 3]) -> Vec<[f32; 3]> {
    let mut random = Random::new(&[n as u64]);
    (0..n).map(|_| map([(); 3].map(|()| random.unit()))).collect()
}

/// Inputs by name: what each is like, and where it is searched.
fn cases() -> Vec<(&'static str, Vec<[f32; 3]>)> {
    let lattice = (0..1000u16).map(|i| [i % 10, i / 10 % 10, i / 100].map(f32::from)).collect();
    let clusters = random_points(900, |[x, y, z]| [(x * 3.0).floor() + y * 1e-4, (y * 2.0).floor(), z * 1e-3]);
    let half = random_points(600, |p| if p[0] < 0.5 { [0.25; 3] } else { p });
    vec![
        ("none", vec![]),
        ("one", vec![[0.5; 3]]),
        ("two", vec![[0.0; 3], [1.0; 3]]),
        ("15", random_points(15, |p| p)),
        ("16", random_points(16, |p| p)),
        ("17", random_points(17, |p| p)),
        ("99", random_points(99, |p| p)),
        ("257", random_points(257, |p| p)),
        ("uniform", random_points(2000, |p| p)),
        ("on a wall", random_points(1500, |[x, _, z]| [x, 0.0, z])),
        ("on a line", random_points(500, |[x, _, _]| [0.3, x, 0.7])),
        ("sorted line", (0..500u16).map(|i| [f32::from(i), 0.0, 0.0]).collect()),
        ("identical", vec![[0.1, 0.2, 0.3]; 1000]),
        ("two sites", (0..1000).map(|i| if i % 2 == 0 { [0.0; 3] } else { [1.0; 3] }).collect()),
        ("half in one spot", half),
        ("lattice with ties", lattice),
        ("clusters", clusters),
        ("offset 1e6", random_points(700, |p| p.map(|x| x + 1e6))),
        ("scale 1e-6", random_points(700, |p| p.map(|x| x * 1e-6))),
        ("denormal", random_points(300, |p| p.map(|x| x * 1e-40))),
        ("huge", random_points(300, |p| p.map(|x| (x - 0.5) * 1e18))),
        ("signed zeros", (0..200).map(|i| if i % 2 == 0 { [0.0; 3] } else { [-0.0; 3] }).collect()),
        ("needle", random_points(500, |[x, y, z]| [x * 1e6, y * 1e-6, z * 1e-6])),
    ]
}

/// Where to search: at photons, beside them, and far away.
fn query_points(positions: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let at = positions.iter().step_by((positions.len() / 20).max(1)).copied();
    let beside = random_points(20, |p| {
        let near = positions.get((p[0] * positions.len() as f32) as usize).copied().unwrap_or([0.0; 3]);
        [near[0] + (p[1] - 0.5) * 0.1, near[1] + (p[2] - 0.5) * 0.1, near[2]]
    });
    at.chain(beside).chain([[1e9, -1e9, 0.0], [0.0; 3]]).collect()
}

/// Every exact map, in every form that it has; fixed cells have room for everything.
fn exact_maps(photons: &[Photon], k: usize) -> Vec<(String, AnyMap)> {
    let mut options = vec![];
    for line in ["32", "128", "320"] {
        options.extend([
            format!("--map bucket-kd --line {line}"),
            format!("--map vvh --line {line}"),
            format!("--map kdb --line {line}"),
            format!("--map grid-fixed --slots {} --line {line}", photons.len().max(1)),
        ]);
    }
    options
        .extend(["--map kd", "--map kd --layout preorder", "--map kd --layout veb", "--map grid"].map(str::to_owned));
    options.extend(
        ["--map kdb --fill 0.4", "--map kdb --pages boxes", "--map kdb --pages boxes --line 64 --fill 0.1"]
            .map(str::to_owned),
    );
    options.push("--map bucket-kd --layout veb --line 64".into());
    options.into_iter().map(|options| (options.clone(), build(&options, photons, k))).collect()
}

/// The map that these options of the command line ask for.
pub(super) fn build(options: &str, photons: &[Photon], k: usize) -> AnyMap {
    use pm_registry::Choice as _;
    let mut words = options.split_whitespace();
    let mut options = MapOptions::default();
    while let Some(option) = words.next() {
        if option == "--pad" {
            options.pad = true;
            continue;
        }
        let value = words.next().unwrap();
        let number = || value.parse().unwrap();
        match option {
            "--map" => options.map = MapKind::of_word(value).unwrap(),
            "--layout" => options.layout = Layout::of_word(value).unwrap(),
            "--pages" => options.pages = PageForm::of_word(value).unwrap(),
            "--orphans" => options.orphans = Orphans::of_word(value).unwrap(),
            "--fill" => options.fill = value.parse().unwrap(),
            "--line" => options.line = number(),
            "--budget" => options.budget = number(),
            "--tables" => options.tables = Some(number()),
            "--thresholds" => options.thresholds = Some(number()),
            "--slots" => options.slots = Some(number()),
            _ => panic!("{option}"),
        }
    }
    assert_eq!(options.problem(), None);
    options.build(photons, k).unwrap()
}

#[test]
fn every_exact_map_finds_what_brute_force_finds() {
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        let oracle = BruteForce::build(&photons).unwrap();
        for (map_name, map) in exact_maps(&photons, 10) {
            assert!(map.is_exact() && map.len() == photons.len());
            for k in [1, 10, 100, photons.len().max(1), photons.len() + 1] {
                let (mut found, mut expected) = (Nearest::new(k, 0.0), Nearest::new(k, 0.0));
                for max_dist in [0.0, 1e-7, 0.05, f32::INFINITY] {
                    for point in query_points(&positions).into_iter().step_by(if k > 100 { 7 } else { 2 }) {
                        Search::new(k, max_dist).run(&oracle, point, &mut expected, &mut Blind);
                        Search::new(k, max_dist).run(&map, point, &mut found, &mut Blind);
                        let asked = format!("{map_name} on {name}, k {k}, max {max_dist}, {point:?}");
                        assert!(found.sorted() == expected.sorted(), "{asked}");
                    }
                }
            }
        }
    }
}

#[test]
fn reads_lie_within_their_regions_and_are_told_apart() {
    let photons = photons(random_points(3000, |[x, y, _]| [x, 0.0, y]));
    for (name, map) in exact_maps(&photons, 50) {
        let regions = map.regions(false);
        let mut visits = Visits::default();
        for photon in photons.iter().step_by(300) {
            map.nearest(photon.position, &mut Nearest::new(50, f32::INFINITY), &mut visits);
        }
        let mut read = vec![0; regions.len()];
        for (region, records) in visits.runs() {
            let records_of_region =
                regions[usize::from(region)].size / u64::from(regions[usize::from(region)].record_size);
            assert!(records.iter().all(|&record| u64::from(record) < records_of_region), "{name}");
            read[usize::from(region)] += records.len();
        }
        assert!(read.iter().all(|&reads| reads > 0), "{name}: {read:?}");
        assert!(visits.photons_examined() >= 500, "{name}");
    }
}

#[test]
fn what_is_carried_from_search_to_search_changes_reads_and_not_neighbours() {
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        for options in ["--map kd", "--map bucket-kd", "--map kdb", "--map grid"] {
            let map = build(options, &photons, 20);
            let (mut found, mut expected) = (Nearest::new(20, 0.0), Nearest::new(20, 0.0));
            for max_dist in [0.03, f32::INFINITY] {
                let plain = Search::new(20, max_dist);
                for search in [plain, plain.fit_start(&map, &photons), Search { start: 1e-9, ..plain }] {
                    let mut carry = Carry::default();
                    for point in query_points(&positions) {
                        plain.run(&map, point, &mut expected, &mut Blind);
                        let attempts = carry.run(&search, &map, point, &mut found, &mut Blind);
                        assert!(found.sorted() == expected.sorted(), "{options} on {name}, {search:?}, {point:?}");
                        // What is carried is enough: only a hint below it can be too small.
                        assert!(attempts == 1 || search != plain, "{options} on {name}, {point:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn carrying_saves_reads_where_queries_are_neighbours() {
    let positions = random_points(20_000, |[x, y, _]| [x, 0.0, y]);
    let photons = photons(positions.iter().copied());
    let map = build("--map bucket-kd", &photons, 100);
    let search = Search::new(100, f32::INFINITY).fit_start(&map, &photons);
    let (mut found, mut carry) = (Nearest::new(100, 0.0), Carry::default());
    let (mut plain, mut carried) = (0u64, 0u64);
    for step in 0..1000u16 {
        let point = [0.3 + f32::from(step) * 1e-4, 0.0, 0.5];
        search.run(&map, point, &mut found, &mut plain);
        carry.run(&search, &map, point, &mut found, &mut carried);
    }
    assert!(carried * 10 < plain * 9, "{carried} {plain}");
}

#[test]
fn padded_records_lie_in_lines() {
    let photons = photons(random_points(100, |p| p));
    for (line, bytes) in [(32, 3200), (128, 17 * 128), (256, 9 * 256)] {
        let map = build(&format!("--map kd --pad --line {line}"), &photons, 10);
        assert_eq!((map.padding(), map.regions(false)[0].size), (Some(line), bytes));
    }
    assert_eq!(build("--map kd", &photons, 10).padding(), None);
}

#[test]
fn the_start_radius_changes_reads_and_not_neighbours() {
    for (name, positions) in cases() {
        let photons = photons(positions.iter().copied());
        let tree = KdTree::build(&photons, Layout::Heap).unwrap();
        let mut found = Nearest::new(20, 0.0);
        let mut expected = Nearest::new(20, 0.0);
        for max_dist in [0.03, f32::INFINITY] {
            let plain = Search::new(20, max_dist);
            let fitted = plain.fit_start(&tree, &photons);
            let searches = [fitted, Search { start: 1e-9, ..plain }, Search { start: 0.01, ..plain }];
            for point in query_points(&positions) {
                plain.run(&tree, point, &mut expected, &mut Blind);
                for search in searches {
                    search.run(&tree, point, &mut found, &mut Blind);
                    assert_eq!(found.sorted(), expected.sorted(), "{name}, {search:?}, {point:?}");
                }
            }
        }
    }
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
    let mut visits = Visits::default();
    let attempts = search.run(&tree, [0.5; 3], &mut Nearest::new(50, 0.0), &mut visits);
    let roots = visits.runs().flat_map(|(_, records)| records).filter(|&&record| record == 0).count();
    assert!(attempts > 3 && roots == attempts as usize, "{attempts} attempts, {roots} roots");
}

#[test]
fn layouts_change_places_and_nothing_else() {
    let photons = photons(random_points(1000, |p| p));
    layouts_agree([Layout::Heap, Layout::Preorder].map(|layout| KdTree::build(&photons, layout).unwrap()));
    layouts_agree([Layout::Heap, Layout::Veb].map(|layout| KdTree::build(&photons, layout).unwrap()));
}

fn layouts_agree(trees: [KdTree; 2]) {
    let mut places: Vec<std::collections::BTreeMap<u32, u32>> = vec![];
    for point in query_points(&[[0.5; 3]]) {
        let runs = trees.each_ref().map(|tree| {
            let (mut found, mut visits) = (Nearest::new(10, f32::INFINITY), Visits::default());
            tree.nearest(point, &mut found, &mut visits);
            (found.sorted(), visits.runs().flat_map(|(_, records)| records.to_vec()).collect::<Vec<_>>())
        });
        assert_eq!(runs[0].0, runs[1].0);
        // The same walk, each node always at the same other place.
        places.push(runs[0].1.iter().copied().zip(runs[1].1.iter().copied()).collect());
        assert_eq!(runs[0].1.len(), runs[1].1.len());
    }
    let mut all = std::collections::BTreeMap::new();
    for (heap, preorder) in places.into_iter().flatten() {
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
    for options in ["kd", "kd --layout veb", "bucket-kd", "vvh", "kdb", "grid", "grid-fixed", "block-hash"] {
        let start = std::time::Instant::now();
        let map = build(&format!("--map {options}"), &photons, 100);
        let mut found = Nearest::new(100, f32::INFINITY);
        map.nearest([0.5, 0.5, 0.4], &mut found, &mut Blind);
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
    let mut list = photons(random_points(10, |p| p));
    list[7].position[1] = f32::NAN;
    assert_eq!(KdTree::build(&list, Layout::Heap).err(), Some(BuildError::Coordinate(7)));
    list[3].position[0] = 1e19;
    assert_eq!(BruteForce::build(&list).err(), Some(BuildError::Coordinate(3)));
}
