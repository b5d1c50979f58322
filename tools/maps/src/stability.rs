//! Where photon maps break: structures by stresses, and what came of each.
//!
//! The table is written to the file that the environment variable `PM_STABILITY_TABLE` names; `make stability` does so.

use super::geometry::extent;
use super::tests::build;
use super::trial::{photons, random_points};
use super::*;
use std::fmt::Write as _;
use std::time::Instant;

/// Photons of a stress, unless its name says otherwise.
const N: usize = 2000;
const K: usize = 50;

/// Maps by the options that ask for them; the last two are approximate.
const MAPS: [(&str, &str); 10] = [
    ("kd", "kd"),
    ("kd veb", "kd --layout veb --pad"),
    ("bucket-kd", "bucket-kd"),
    ("bucket 320", "bucket-kd --line 320"),
    ("wide", "wide"),
    ("vvh", "vvh"),
    ("kdb", "kdb"),
    ("grid", "grid"),
    ("grid-fixed", "grid-fixed"),
    ("block-hash", "block-hash --line 256"),
];

/// Something that is hard for some structure.
struct Stress {
    name: &'static str,
    positions: Vec<[f32; 3]>,
    k: usize,
    max_dist: f32,
}

fn stresses() -> Vec<Stress> {
    let wall = |n: usize| random_points(n, |[x, _, z]| [x, 0.0, z]);
    let room = || {
        random_points(N, |[u, v, w]| match (w * 5.0) as u32 {
            0 => [u, v, 0.0],
            1 => [u, v, 1.0],
            2 => [0.0, u, v],
            3 => [1.0, u, v],
            _ => [u, 0.0, v],
        })
    };
    let clusters =
        random_points(N, |[x, y, z]| [(x * 5.0).floor() + y * 1e-4, (y * 4.0).floor() + z * 1e-4, x * y * z * 1e-4]);
    let lattice = (0..13 * 13 * 13u16).map(|i| [i % 13, i / 13 % 13, i / 169].map(f32::from)).collect();
    let hot = random_points(N, |p| if p[0] < 0.5 { p.map(|x| 0.25 + x * 1e-5) } else { p });
    let sites = (0..N).map(|i| if i % 2 == 0 { [0.0; 3] } else { [1.0; 3] }).collect();
    let stress = |name, positions| Stress { name, positions, k: K, max_dist: f32::INFINITY };
    vec![
        stress("uniform", random_points(N, |p| p)),
        stress("surface", room()),
        stress("clustered", clusters),
        stress("half in one spot", hot),
        stress("all identical", vec![[0.1, 0.2, 0.3]; N]),
        stress("two sites", sites),
        stress("all coplanar", wall(N)),
        stress("all collinear", random_points(N, |[x, _, _]| [0.3, x, 0.7])),
        stress("lattice with ties", lattice),
        stress("no photon", vec![]),
        stress("1 photon", vec![[0.5; 3]]),
        stress("fewer than k", wall(K - 1)),
        Stress { k: 1, ..stress("k = 1", room()) },
        Stress { k: N, ..stress("k = N", room()) },
        stress("coordinates at 1e6", random_points(N, |[x, _, z]| [x + 1e6, 1e6, z - 1e6])),
        stress("coordinates at 1e-6", random_points(N, |[x, _, z]| [x, 0.0, z].map(|x| x * 1e-6))),
        stress("coordinates at 1e18", random_points(N, |p| p.map(|x| (x - 0.5) * 1e18))),
        stress("needle", random_points(N, |[x, y, z]| [x * 1e6, y * 1e-6, z * 1e-6])),
        Stress { max_dist: 1e-9, ..stress("max-dist 1e-9", room()) },
        Stress { max_dist: 0.05, ..stress("max-dist 0.05", room()) },
    ]
}

/// Where a stress is searched: at its photons, a little beside them, between them, and far away.
fn points(positions: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let (low, high) = if positions.is_empty() { ([0.0; 3], [1.0; 3]) } else { extent(positions.iter().copied()) };
    let size = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f32::max);
    let at = positions.iter().step_by((positions.len() / 20).max(1)).copied();
    let beside: Vec<_> = at.clone().map(|[x, y, z]| [x + size * 1e-3, y, z - size * 1e-3]).collect();
    let between = random_points(10, |p| [0, 1, 2].map(|axis| low[axis] + p[axis] * (high[axis] - low[axis])));
    at.chain(beside).chain(between).chain([high.map(|x| x + 10.0 * size + 1.0)]).collect()
}

/// What came of a map under a stress: true to the oracle, and how many photons were looked at for each query.
fn outcome(map: &dyn AnyMap, stress: &Stress, oracle: &BruteForce) -> String {
    let search = Search::new(stress.k, stress.max_dist);
    let points = points(&stress.positions);
    let (mut found, mut expected) = (Nearest::new(stress.k, 0.0), Nearest::new(stress.k, 0.0));
    let mut reads = SearchReads::default();
    let mut same = true;
    for &point in &points {
        search.run(map, point, &mut found, &mut reads);
        search.run(oracle, point, &mut expected, &mut Blind);
        same &= found.sorted() == expected.sorted();
    }
    let examined = reads.photons_examined() / points.len() as u64;
    assert!(same || !map.is_exact(), "{}: an exact map found other neighbours", stress.name);
    let recall = Accuracy::measure(map, oracle, search, &points, None, |_, _, _| {}).mean_recall();
    if same { format!("exact {examined}") } else { format!("{recall:.2} {examined}") }
}

#[test]
fn every_exact_map_is_exact_under_every_stress() {
    let width = 12;
    let mut table = format!("{:20}", "");
    MAPS.iter().for_each(|(name, _)| write!(table, "{name:>width$}").unwrap());
    for stress in stresses() {
        let photons = photons(stress.positions.iter().copied());
        let oracle = BruteForce::build(&photons).unwrap();
        write!(table, "\n{:20}", stress.name).unwrap();
        for (_, options) in MAPS {
            let map = build(options, &photons, stress.k);
            write!(table, "{:>width$}", outcome(&*map, &stress, &oracle)).unwrap();
        }
    }
    table += "\n\nexact or the mean recall, and the photons examined per query\n";
    if let Some(file) = std::env::var_os("PM_STABILITY_TABLE") {
        std::fs::write(file, table + &building(1_000_000)).unwrap();
    }
}

/// What it takes to build maps of so many photons, where medians, cells or buckets might fail to tell them apart.
fn building(n: usize) -> String {
    let width = 12;
    let mut table = format!("\n{:20}", n);
    MAPS.iter().for_each(|(name, _)| write!(table, "{name:>width$}").unwrap());
    for (name, positions) in [
        ("uniform", random_points(n, |p| p)),
        ("all identical", vec![[0.1, 0.2, 0.3]; n]),
        ("two sites", (0..n).map(|i| if i % 2 == 0 { [0.0; 3] } else { [1.0; 3] }).collect()),
        ("all coplanar", random_points(n, |[x, _, z]| [x, 0.0, z])),
        ("all collinear", random_points(n, |[x, _, _]| [0.3, x, 0.7])),
        ("in rising order", (0..n).map(|i| [i as f32, 0.0, 0.0]).collect()),
    ] {
        let photons = photons(positions);
        write!(table, "\n{name:20}").unwrap();
        for (_, options) in MAPS {
            let start = Instant::now();
            let _map = build(options, &photons, K);
            write!(table, "{:>width$.2}", start.elapsed().as_secs_f64()).unwrap();
        }
    }
    table + "\n\nseconds to build a map of so many photons\n"
}
