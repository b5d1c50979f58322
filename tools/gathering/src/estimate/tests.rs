//! Is the estimate what its definition says?

use super::*;
use bytemuck::Zeroable as _;
use glam::Vec3;
use pm_formats::{Material, Photon, Query};
use pm_maps::{Blind, BruteForce, Nearest, PhotonMap as _, Search, WideTree};
use pm_random::Random;
use std::f64::consts::PI;

const UP: [f32; 3] = [0.0, 1.0, 0.0];

fn material() -> Vec<Material> {
    vec![Material { name: "m".into(), diffuse: [0.5, 0.25, 1.0], specular: [0.0; 3], exponent: 0.0 }]
}

fn query() -> Query {
    let (normal, view) = Query::pack_vectors(UP, UP);
    Query { normal, view, weight: [1.0, 2.0, 1.0], ..Query::zeroed() }
}

fn photon(x: f32, power: f32, normal: [f32; 3]) -> Photon {
    Photon::new([x, 0.0, 0.0], [power; 3], [0.5; 3], UP, normal).unwrap()
}

fn estimate(photons: &[Photon], emitted: u64, k: usize, max_dist: f32, estimator: Estimator) -> Outcome {
    let options = EstimateOptions { k, max_dist, estimator, kernel: Kernel::Constant, edges: Edges::Ignored };
    estimate_with(photons, emitted, options, &material(), &query())
}

fn estimate_with(
    photons: &[Photon],
    emitted: u64,
    options: EstimateOptions,
    materials: &[Material],
    query: &Query,
) -> Outcome {
    let estimate = RadianceEstimate::new(photons, materials, emitted, options);
    let mut found = Nearest::new(options.k, options.max_dist * options.max_dist);
    let at = Vec3::from(query.position);
    (0..).zip(photons).for_each(|(id, photon)| found.show(at.distance_squared(photon.position.into()), id));
    estimate.contribution(query, &found, &mut Scratch::default())
}

/// flux / (area * emitted) * weight * diffuse / pi, by hand.
fn by_hand(flux: f64, radius: f64, emitted: f64) -> Outcome {
    let each = flux / (PI * radius * radius * emitted) / PI;
    Outcome::Radiance([0.5 * each, 2.0 * 0.25 * each, each])
}

fn assert_close(a: Outcome, b: Outcome) {
    let (Outcome::Radiance(a), Outcome::Radiance(b)) = (a, b) else { panic!("{a:?} {b:?}") };
    assert!((0..3).all(|i| (a[i] - b[i]).abs() <= 1e-12 * b[i].abs()), "{a:?} {b:?}");
}

#[test]
fn the_kth_photon_sets_the_radius_and_is_not_summed() {
    let photons: Vec<_> = [1.0, 2.0, 4.0].iter().map(|&x| photon(x, 8.0, UP)).collect();
    assert_close(estimate(&photons, 10, 3, f32::INFINITY, Estimator::Unbiased), by_hand(16.0, 4.0, 10.0));
    assert_close(estimate(&photons, 10, 3, f32::INFINITY, Estimator::Classic), by_hand(24.0, 4.0, 10.0));
}

#[test]
fn the_limit_is_the_radius_where_it_cuts_the_search_short() {
    let photons: Vec<_> = [1.0, 2.0, 4.0].iter().map(|&x| photon(x, 8.0, UP)).collect();
    assert_close(estimate(&photons, 1, 3, 3.0, Estimator::Unbiased), by_hand(16.0, 3.0, 1.0));
    assert_eq!(estimate(&photons, 1, 3, 0.5, Estimator::Unbiased), Outcome::Radiance([0.0; 3]));
    // Fewer photons than k and no limit: the farthest stands for the k-th.
    assert_close(estimate(&photons, 1, 9, f32::INFINITY, Estimator::Unbiased), by_hand(16.0, 4.0, 1.0));
    assert_eq!(estimate(&[], 1, 9, f32::INFINITY, Estimator::Unbiased), Outcome::Radiance([0.0; 3]));
}

#[test]
fn photons_round_the_corner_and_behind_are_left_out_of_the_sum_only() {
    let photons = [photon(1.0, 8.0, UP), photon(1.5, 8.0, [1.0, 0.0, 0.0]), photon(2.0, 8.0, [0.0, -1.0, 0.0])];
    // The last, behind, still sets the radius.
    assert_close(estimate(&photons, 1, 3, f32::INFINITY, Estimator::Classic), by_hand(8.0, 2.0, 1.0));
}

#[test]
fn photons_at_the_query_itself_say_nothing() {
    let photons = [photon(0.0, 8.0, UP), photon(0.0, 8.0, UP)];
    assert_eq!(estimate(&photons, 1, 2, f32::INFINITY, Estimator::Unbiased), Outcome::NoArea);
}

#[test]
fn an_even_density_is_estimated_without_bias() {
    // Photons of flux 1 at 200 a unit area: irradiance 200. The classic form is k/(k-1) too bright.
    let mut random = Random::new(&[7]);
    let (k, runs) = (10, 4000);
    let mut mean = [0.0; 2];
    for _ in 0..runs {
        // In a disc of radius 1, distance squared is uniform.
        let n = (200.0 * PI) as usize;
        let photons: Vec<_> = (0..n).map(|_| photon(random.unit().sqrt(), 1.0, UP)).collect();
        for (mean, estimator) in mean.iter_mut().zip([Estimator::Unbiased, Estimator::Classic]) {
            let Outcome::Radiance([r, ..]) = estimate(&photons, 1, k, f32::INFINITY, estimator) else { panic!() };
            *mean += r / f64::from(runs) * PI / 0.5 / 200.0;
        }
    }
    // Standard error 1 / sqrt((k - 2) runs) = 0.0056.
    assert!((mean[0] - 1.0).abs() < 0.02, "{mean:?}");
    assert!((mean[1] - 10.0 / 9.0).abs() < 0.02, "{mean:?}");
}

#[test]
fn sums_of_powers_far_apart_do_not_depend_on_the_order_found() {
    // Powers over 2^80: no double holds their sum exactly, so the order of addition would show.
    let mut photons: Vec<_> = (0..50u8).map(|i| photon(1.0, 1.37 * 2f32.powi(i32::from(i) * 2 - 60), UP)).collect();
    photons.push(photon(2.0, 1.0, UP));
    assert_free_of_order(&photons, &material(), EstimateOptions { k: 51, ..OPTIONS });
}

/// The estimate is the same whether photons are shown from the first to the last or the other way round.
fn assert_free_of_order(photons: &[Photon], materials: &[Material], options: EstimateOptions) {
    let estimate = RadianceEstimate::new(photons, materials, 1, options);
    let outcome = |order: &mut dyn Iterator<Item = u32>| {
        let mut found = Nearest::new(options.k, f32::INFINITY);
        order.for_each(|id| found.show(Vec3::from(photons[id as usize].position).length_squared(), id));
        estimate.contribution(&query(), &found, &mut Scratch::default())
    };
    let n = photons.len() as u32;
    let forth = outcome(&mut (0..n));
    assert!(matches!(forth, Outcome::Radiance([r, ..]) if r > 0.0), "{forth:?}");
    assert_eq!(forth, outcome(&mut (0..n).rev()));
}

const KERNELS: [Kernel; 3] = [Kernel::Constant, Kernel::Cone, Kernel::Epanechnikov];

const OPTIONS: EstimateOptions = EstimateOptions {
    k: 10,
    max_dist: f32::INFINITY,
    estimator: Estimator::Unbiased,
    kernel: Kernel::Constant,
    edges: Edges::Cut,
};

#[test]
fn every_kernel_is_unbiased_on_an_even_density() {
    let mut random = Random::new(&[8]);
    let runs = 4000;
    let mut mean = [0.0; 3];
    for _ in 0..runs {
        let photons: Vec<_> = (0..628).map(|_| photon(random.unit().sqrt(), 1.0, UP)).collect();
        for (mean, kernel) in mean.iter_mut().zip(KERNELS) {
            let options = EstimateOptions { kernel, ..OPTIONS };
            let Outcome::Radiance([r, ..]) = estimate_with(&photons, 1, options, &material(), &query()) else {
                panic!()
            };
            *mean += r / f64::from(runs) * PI / 0.5 / (628.0 / PI);
        }
    }
    // Standard errors 0.0056 and, for kernels that make less of the photons, some 0.007.
    assert!(mean.iter().all(|mean| (mean - 1.0).abs() < 0.025), "{mean:?}");
}

#[test]
fn kernels_weigh_by_distance() {
    // Photons at 1 and 2 of a radius of 4: 3/(pi r^2) (3/4 + 2/4) and 2/(pi r^2) (15/16 + 12/16), times 8.
    let photons: Vec<_> = [1.0, 2.0, 4.0].iter().map(|&x| photon(x, 8.0, UP)).collect();
    for (kernel, flux) in [(Kernel::Cone, 3.0 * 1.25 * 8.0), (Kernel::Epanechnikov, 2.0 * 27.0 / 16.0 * 8.0)] {
        let options = EstimateOptions { k: 3, kernel, ..OPTIONS };
        assert_close(estimate_with(&photons, 10, options, &material(), &query()), by_hand(flux, 4.0, 10.0));
    }
}

/// Photons spread evenly, `density` a unit area, over a floor (y = 0) and walls x = -`wall` and z = -`wall`; near the
/// origin only.
fn corner(random: &mut Random, density: f32, wall: f32, walls: usize) -> Vec<Photon> {
    let size = 0.6;
    let floor = (size + wall) * if walls == 2 { size + wall } else { 2.0 * size };
    let areas = [floor, size * 2.0 * size, size * 2.0 * size];
    let mut photons = vec![];
    for (surface, area) in areas.iter().enumerate().take(1 + walls) {
        for _ in 0..(density * area) as usize {
            let (u, v) = (random.unit(), random.unit());
            let z_from = if walls == 2 { -wall } else { -size };
            let (position, normal) = match surface {
                0 => ([-wall + u * (size + wall), 0.0, z_from + v * (size - z_from)], UP),
                1 => ([-wall, u * size, (v * 2.0 - 1.0) * size], [1.0, 0.0, 0.0]),
                _ => ([(v * 2.0 - 1.0) * size, u * size, -wall], [0.0, 0.0, 1.0]),
            };
            // The walls end where they meet.
            if position[0] >= -wall && position[2] >= z_from {
                photons.push(Photon::new(position, [1.0; 3], [0.5; 3], UP, normal).unwrap());
            }
        }
    }
    photons
}

#[test]
fn at_an_edge_and_in_a_corner_the_estimate_is_that_of_the_middle() {
    // 2,000 photons a unit area on each surface; r_k is some 0.04 for k = 10. What is not cut loses up to a half at an
    // edge and three quarters in a corner.
    let mut random = Random::new(&[9]);
    let runs = 1500;
    for (walls, wall, least_loss) in [(1, 0.0, 0.4), (1, 0.01, 0.2), (1, 0.03, 0.0), (2, 0.0, 0.6), (2, 0.01, 0.4)] {
        let mut mean = [0.0; 4];
        for _ in 0..runs {
            let photons = corner(&mut random, 2000.0, wall, walls);
            let with = KERNELS.map(|kernel| EstimateOptions { kernel, ..OPTIONS });
            let options = with.into_iter().chain([EstimateOptions { edges: Edges::Ignored, ..OPTIONS }]);
            for (mean, options) in mean.iter_mut().zip(options) {
                let Outcome::Radiance([r, ..]) = estimate_with(&photons, 1, options, &material(), &query()) else {
                    panic!()
                };
                *mean += r / f64::from(runs) * PI / 0.5 / 2000.0;
            }
        }
        // Standard error about 1 / sqrt(4 runs) = 0.013 with a half of the photons.
        assert!(mean[..3].iter().all(|mean| (mean - 1.0).abs() < 0.05), "{walls} walls at {wall}: {mean:?}");
        assert!(mean[3] < 1.0 - least_loss, "{walls} walls at {wall}: nothing to cure: {mean:?}");
    }
}

#[test]
fn cuts_that_leave_nothing_are_not_made() {
    // The planes of two strangers pass through the query and leave it opposite halves of its surface.
    let own = [0.6, 0.8, 0.0];
    let at = |position: [f32; 3], normal: [f32; 3]| Photon::new(position, [8.0; 3], [0.5; 3], own, normal).unwrap();
    let photons = [
        at([0.0; 3], own),
        at([-1.0, 0.0, 0.0], UP),
        at([1.0, 0.0, 0.0], own),
        at([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
        at([0.0, 0.0, 2.0], own),
    ];
    let (normal, view) = Query::pack_vectors(own, own);
    let query = Query { normal, view, ..query() };
    let options = EstimateOptions { k: 5, ..OPTIONS };
    assert_close(estimate_with(&photons, 1, options, &material(), &query), by_hand(16.0, 2.0, 1.0));
}

#[test]
fn rounded_sums_and_cuts_do_not_depend_on_the_order_found() {
    let mut random = Random::new(&[10]);
    let photons = corner(&mut random, 2000.0, 0.01, 2);
    let glossy = vec![Material { specular: [0.5; 3], exponent: 7.0, ..material()[0].clone() }];
    for kernel in KERNELS {
        for materials in [material(), glossy.clone()] {
            assert_free_of_order(&photons, &materials, EstimateOptions { k: 100, kernel, ..OPTIONS });
        }
    }
}

#[test]
fn a_glossy_surface_weighs_photons_by_where_they_come_from() {
    // Seen at 45 degrees; light along the mirrored direction, straight from above, and from where the viewer is.
    let towards = |x: f32| Vec3::new(x, 1.0, 0.0).normalize();
    let (normal, view) = Query::pack_vectors(UP, towards(1.0).into());
    let query = Query { normal, view, weight: [1.0; 3], ..Query::zeroed() };
    let materials = vec![Material { specular: [0.3; 3], exponent: 20.0, ..material()[0].clone() }];
    let slant = 0.5f64.sqrt();
    for (x, cosine, larger) in [(-1.0, 1.0, slant), (0.0, slant, 1.0), (1.0, 0.0, slant)] {
        let direction = towards(x).into();
        let photons = [0.1, 1.0].map(|at| Photon::new([at, 0.0, 0.0], [8.0; 3], [0.5; 3], direction, UP).unwrap());
        let options = EstimateOptions { k: 2, ..OPTIONS };
        let Outcome::Radiance(found) = estimate_with(&photons, 1, options, &materials, &query) else { panic!() };
        let lobe = 0.3 * 22.0 / (2.0 * PI) * f64::powi(cosine, 20) / larger;
        for (found, diffuse) in found.into_iter().zip([0.5, 0.25, 1.0]) {
            let expected = (diffuse / PI + lobe) * 8.0 / PI;
            // A photon's direction is packed to 0.016 rad: 1 - 20 x 0.016^2 / 2 at the peak, more on its slope.
            assert!((found / expected - 1.0).abs() < 0.01, "{x}: {found} for {expected}");
        }
    }
}

#[test]
fn the_order_of_a_map_changes_nothing() {
    // In a corner, so that there are strangers; of even power, of powers that differ a little, and much.
    let mut random = Random::new(&[11]);
    let photons = corner(&mut random, 2000.0, 0.01, 2);
    let glossy = vec![Material { specular: [0.5; 3], exponent: 7.0, ..material()[0].clone() }];
    for spread in [0, 5, 40] {
        let power = |random: &mut Random| 1.37 * 2f32.powi((random.unit() * spread as f32) as i32 - 20);
        let photons: Vec<Photon> = photons
            .iter()
            .map(|photon| {
                let power = [power(&mut random), power(&mut random), 0.0];
                Photon::new(photon.position, power, [0.5; 3], UP, photon.normal()).unwrap()
            })
            .collect();
        let (wide, brute) = (WideTree::build(&photons).unwrap(), BruteForce::build(&photons).unwrap());
        for (kernel, materials) in
            [(Kernel::Constant, material()), (Kernel::Cone, material()), (Kernel::Constant, glossy.clone())]
        {
            let options = EstimateOptions { k: 40, kernel, ..OPTIONS };
            let by_id = RadianceEstimate::new(&photons, &materials, 1, options);
            let by_place = RadianceEstimate::new(&photons, &materials, 1, options).in_order(wide.order());
            let (mut found, mut other) = (Nearest::new(40, 0.0), Nearest::new(40, 0.0));
            let mut scratch = Scratch::default();
            for step in 0..60u8 {
                let position = [f32::from(step) / 200.0, 0.0, f32::from(step % 7) / 40.0];
                let query = Query { position, ..query() };
                Search::new(40, f32::INFINITY).run(&wide, position, &mut found, &mut Blind);
                Search::new(40, f32::INFINITY).run(&brute, position, &mut other, &mut Blind);
                let expected = by_id.contribution(&query, &other, &mut scratch);
                assert!(matches!(expected, Outcome::Radiance([r, ..]) if r > 0.0), "{expected:?}");
                for estimate in [&by_id, &by_place] {
                    for found in [&found, &other] {
                        assert_eq!(
                            estimate.contribution(&query, found, &mut scratch),
                            expected,
                            "{spread}, {kernel:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn what_is_remembered_of_the_query_before_changes_nothing() {
    // On the floor and on a wall, in the corner and far from it, by turns and one after the other.
    let mut random = Random::new(&[15]);
    let photons = corner(&mut random, 2000.0, 0.01, 2);
    let wide = WideTree::build(&photons).unwrap();
    for edges in [Edges::Cut, Edges::Ignored] {
        let options = EstimateOptions { k: 40, edges, ..OPTIONS };
        let materials = material();
        let estimate = RadianceEstimate::new(&photons, &materials, 1, options).in_order(wide.order());
        let (mut found, mut scratch) = (Nearest::new(40, 0.0), Scratch::default());
        let (mut near, mut far) = (0, 0);
        for _ in 0..600 {
            let along = (random.unit() * 3.0).floor() * 0.15;
            let (position, normal) = match random.unit() < 0.7 {
                true => ([along, 0.0, along + 0.02], UP),
                false => ([-0.01, along + 0.01, along], [1.0, 0.0, 0.0]),
            };
            let (normal, view) = Query::pack_vectors(normal, UP);
            let query = Query { position, normal, view, ..query() };
            Search::new(40, f32::INFINITY).run(&wide, position, &mut found, &mut Blind);
            let outcome = estimate.contribution(&query, &found, &mut scratch);
            assert_eq!(outcome, estimate.contribution(&query, &found, &mut Scratch::default()));
            *if scratch.near_edge { &mut near } else { &mut far } += 1;
        }
        assert!(near > 100 && far > 100, "{near} {far}");
    }
}
