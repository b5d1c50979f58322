//! Does a query meet the photons that have it within their radius, as looking at all of them says, and is no light lost?

use super::*;
use crate::{Edges, EstimateOptions, Estimator, RadianceEstimate};
use bytemuck::Zeroable as _;
use pm_formats::Photon;
use pm_maps::geometry::distance_squared;
use pm_maps::{Blind, KdTree, Layout, Search};
use pm_random::Random;

const UP: [f32; 3] = [0.0, 1.0, 0.0];

fn materials() -> Vec<Material> {
    let matt = Material { name: "m".into(), diffuse: [0.5, 0.25, 1.0], specular: [0.0; 3], exponent: 0.0 };
    vec![matt.clone(), Material { specular: [0.3; 3], exponent: 5.0, ..matt }]
}

fn photon(position: [f32; 3], normal: [f32; 3]) -> Photon {
    Photon::new(position, [1.0; 3], [0.5; 3], normal, normal).unwrap()
}

fn query(position: [f32; 3]) -> Query {
    let (normal, view) = Query::pack_vectors(UP, UP);
    Query { position, normal, view, weight: [1.0, 2.0, 1.0], ..Query::zeroed() }
}

/// Calls `test` with the radii of these photons.
fn with_radii<T>(
    photons: &[Photon],
    k: usize,
    kernel: Kernel,
    edges: Edges,
    test: impl FnOnce(PhotonRadii<'_>) -> T,
) -> T {
    let (map, materials) = (KdTree::build(photons, Layout::Heap).unwrap(), materials());
    let options = EstimateOptions { k, max_dist: f32::INFINITY, estimator: Estimator::Unbiased, kernel, edges };
    let estimate = RadianceEstimate::new(photons, &materials, 1, options);
    let search = Search::new(k, f32::INFINITY);
    let how = Precomputation {
        map: &map,
        search,
        reread: false,
        photons,
        estimate: &estimate,
        share: 1,
        materials: &materials,
    };
    let mut radii = PhotonRadii::new(&how, 2).unwrap();
    radii.lay_out(vec![]);
    test(radii)
}

fn points(random: &mut Random, n: usize, map: fn([f32; 3]) -> [f32; 3]) -> Vec<Photon> {
    (0..n).map(|_| photon(map([(); 3].map(|()| random.unit())), UP)).collect()
}

/// Radiance of the white channel at a point, by lambert's law as irradiance; 0 where no photon reaches.
fn irradiance(radii: &PhotonRadii<'_>, position: [f32; 3]) -> f64 {
    match radii.contribution(&query(position), &mut SearchReads::default()) {
        Some(Outcome::Radiance([.., blue])) => blue * PI,
        _ => 0.0,
    }
}

#[test]
fn those_who_reach_a_point_are_those_that_looking_at_all_finds() {
    let mut random = Random::new(&[21]);
    let lattice = (0..1000u16).map(|i| photon([i % 10, i / 10 % 10, i / 100].map(f32::from), UP)).collect();
    let cases: Vec<(&str, Vec<Photon>)> = vec![
        ("none", vec![]),
        ("one", points(&mut random, 1, |p| p)),
        ("seven", points(&mut random, 7, |p| p)),
        ("uniform", points(&mut random, 900, |p| p)),
        ("on a wall", points(&mut random, 500, |[x, _, z]| [x, 0.0, z])),
        ("dense on one side", points(&mut random, 700, |[x, y, z]| [x * x * x * x, y, z])),
        ("lattice with ties", lattice),
        ("offset 1e6", points(&mut random, 400, |p| p.map(|x| x + 1e6))),
        ("scale 1e-6", points(&mut random, 400, |p| p.map(|x| x * 1e-6))),
    ];
    for (name, photons) in cases {
        for k in [2, 10, 60] {
            // O(n^2): the k-th of all distances, the photon itself among them.
            let radius = |from: &Photon| {
                let mut all: Vec<f32> = photons.iter().map(|to| distance_squared(from.position, to.position)).collect();
                all.sort_by(f32::total_cmp);
                f64::from(all[k.min(all.len()) - 1])
            };
            let radii: Vec<f64> = photons.iter().map(radius).collect();
            with_radii(&photons, k, Kernel::Constant, Edges::Ignored, |held| {
                let at = photons.iter().step_by(9).map(|it| it.position);
                let near = at.clone().map(|p| p.map(|x| x * 1.01 + 0.003));
                for point in at.chain(near) {
                    let mut found = vec![];
                    held.reaching(point, &mut Blind, |disc, _| found.push((disc.position(), disc.density())));
                    let mut expected = vec![];
                    for (photon, &squared) in photons.iter().zip(&radii) {
                        // A radius is kept as a float, whose square is not the distance's to the last bit: not on the rim.
                        let distance = f64::from(distance_squared(photon.position, point));
                        let is_rim = (distance / squared - 1.0).abs() < 1e-6;
                        found.retain(|&(position, _)| position != photon.position || !is_rim);
                        if squared > 0.0 && distance <= squared && !is_rim {
                            expected.push((photon.position, 1.0 / (PI * squared)));
                        }
                    }
                    let key = |p: [f32; 3]| p.map(f32::to_bits);
                    found.sort_by_key(|&(position, _)| key(position));
                    expected.sort_by_key(|&(position, _)| key(position));
                    assert_eq!(found.len(), expected.len(), "{name}, k = {k}, at {point:?}");
                    for ((a, density), (b, known)) in found.into_iter().zip(expected) {
                        assert_eq!(a, b, "{name}, k = {k}");
                        // A mantissa of 8 bits.
                        assert!((density[0] / known - 1.0).abs() < 1.0 / 120.0, "{name}: {density:?} {known}");
                    }
                }
            });
        }
    }
}

#[test]
fn reads_are_lines_within_the_regions_each_once() {
    let photons = points(&mut Random::new(&[22]), 3000, |[x, _, z]| [x, 0.0, z]);
    with_radii(&photons, 20, Kernel::Constant, Edges::Cut, |mut held| {
        let regions = held.lay_out(vec![]);
        assert_eq!(regions.iter().map(|it| &it.name[..]).collect::<Vec<_>>(), ["boxes", "discs"]);
        // 750 leaves of 4; 150, 30, 6 and 2 nodes of 5, and the root.
        assert_eq!(regions.iter().map(|it| it.size / 128).collect::<Vec<_>>(), [150 + 30 + 6 + 2 + 1, 750]);
        let mut reads = SearchReads::default();
        held.contribution(&query([0.5, 0.0, 0.5]), &mut reads).unwrap();
        let mut all: Vec<(u16, u32)> =
            reads.runs().flat_map(|(region, records)| records.iter().map(move |&it| (region, it))).collect();
        assert!(all.iter().all(|&(region, it)| u64::from(it) < regions[usize::from(region)].size / 128));
        let many = all.len();
        all.sort_unstable();
        all.dedup();
        assert!(all.len() == many && (8..60).contains(&many), "{all:?}");
    });
}

#[test]
fn on_an_even_plane_the_flux_is_the_known_one_whatever_k_and_kernel() {
    // 4,000 photons of flux 1 on a unit square: irradiance 4,000 in its middle. The k nearest of a query, all summed, would
    // be k / (k - 1) too bright: a third for k = 4.
    let mut random = Random::new(&[23]);
    for kernel in [Kernel::Constant, Kernel::Cone, Kernel::Epanechnikov] {
        for k in [4, 30] {
            let (mut sum, mut count) = (0.0, 0.0);
            for _ in 0..10 {
                let photons = points(&mut random, 4000, |[x, _, z]| [x, 0.0, z]);
                with_radii(&photons, k, kernel, Edges::Ignored, |held| {
                    for i in 0..900u16 {
                        let at = [i % 30, i / 30].map(|i| 0.2 + 0.6 * (f32::from(i) + 0.5) / 30.0);
                        sum += irradiance(&held, [at[0], 0.0, at[1]]);
                        count += 1.0;
                    }
                });
            }
            // 14,400 photons lie where it is asked: a standard error of 0.8 %.
            let mean: f64 = sum / count / 4000.0;
            assert!((mean - 1.0).abs() < 0.03, "{kernel:?}, k = {k}: {mean}");
        }
    }
}

#[test]
fn what_is_spread_moves_away_from_an_edge_and_not_through_the_wall() {
    // A floor and a wall (x = 0), as bright as each other, and a dark floor behind. The foot of the wall is reached by photons
    // up to a radius away, whose discs have the area A(t) on this side of a cut at t radii, of which the chord is the derivative:
    // the integral of A'/A from 0 to 1 is the logarithm of A(1) / A(0), of 2. Of whole areas, 1/2. Behind the wall comes nothing.
    let mut random = Random::new(&[24]);
    let known = 2f64.ln();
    let mut mean = [0.0; 2];
    for _ in 0..12 {
        let mut photons = points(&mut random, 4000, |[x, _, z]| [x, 0.0, z]);
        photons.extend(
            points(&mut random, 4000, |[_, y, z]| [0.0, y, z]).iter().map(|it| photon(it.position, [1.0, 0.0, 0.0])),
        );
        for (mean, edges) in mean.iter_mut().zip([Edges::Cut, Edges::Ignored]) {
            with_radii(&photons, 60, Kernel::Constant, edges, |held| {
                for i in 0..200u16 {
                    let z = 0.2 + 0.6 * f32::from(i) / 200.0;
                    *mean += irradiance(&held, [1e-4, 0.0, z]) / 4000.0 / 200.0 / 12.0;
                    assert!(irradiance(&held, [-0.01, 0.0, z]) == 0.0, "light goes through the wall, {edges:?}");
                }
            });
        }
    }
    assert!((mean[0] - known).abs() < 0.05 && (mean[1] - 0.5).abs() < 0.05, "{mean:?}, {known}");
}

#[test]
fn a_glossy_surface_is_lit_by_its_lobe_as_well() {
    // Light from straight above, seen from straight above: diffuse / pi, and the lobe's peak.
    let photons = points(&mut Random::new(&[25]), 500, |[x, _, z]| [x, 0.0, z]);
    with_radii(&photons, 20, Kernel::Constant, Edges::Cut, |held| {
        let at = |material| match held
            .contribution(&Query { material, ..query([0.5, 0.0, 0.5]) }, &mut SearchReads::default())
        {
            Some(Outcome::Radiance([red, ..])) => red,
            other => panic!("{other:?}"),
        };
        let known = (0.5 / PI + 0.3 * 7.0 / (2.0 * PI)) / (0.5 / PI);
        assert!((at(1) / at(0) / known - 1.0).abs() < 0.01, "{} for {known}", at(1) / at(0));
    });
}

#[test]
fn a_point_that_no_photon_reaches_is_told_nothing_and_discs_without_area_are_left_out() {
    let mut photons = points(&mut Random::new(&[26]), 200, |[x, _, z]| [x, 0.0, z]);
    photons.extend([photon([5.0, 0.0, 5.0], UP); 10]);
    with_radii(&photons, 10, Kernel::Constant, Edges::Cut, |held| {
        assert_eq!((held.discs.len(), held.built.no_area), (200, 10));
        for far in [[5.0, 0.0, 5.0], [3.0, 0.0, 0.5], [f32::NAN; 3]] {
            assert_eq!(held.contribution(&query(far), &mut SearchReads::default()), None, "{far:?}");
        }
    });
}
