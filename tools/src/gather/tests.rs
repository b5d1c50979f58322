//! Is the estimate what its definition says?

use super::*;
use crate::photon_map::Nearest;
use crate::random::Random;
use bytemuck::Zeroable as _;
use pm_formats::{Material, Photon, Query};
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

fn found(photons: &[Photon], k: usize, max_dist: f32) -> Nearest {
    let mut found = Nearest::new(k, max_dist * max_dist);
    (0..).zip(photons).for_each(|(id, photon)| found.show(photon.position[0].powi(2), id));
    found
}

fn estimate(photons: &[Photon], emitted: u64, k: usize, max_dist: f32, estimator: Estimator) -> Outcome {
    let materials = material();
    let estimate = RadianceEstimate::new(photons, &materials, emitted, k, max_dist, estimator);
    estimate.contribution(&query(), &found(photons, k, max_dist), &mut vec![])
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
    let materials = material();
    let estimate = RadianceEstimate::new(&photons, &materials, 1, 51, f32::INFINITY, Estimator::Unbiased);
    let outcome = |order: &[u32]| {
        let mut found = Nearest::new(51, f32::INFINITY);
        order.iter().for_each(|&id| found.show(photons[id as usize].position[0].powi(2), id));
        estimate.contribution(&query(), &found, &mut vec![])
    };
    let forth: Vec<u32> = (0..51).collect();
    let back: Vec<u32> = (0..51).rev().collect();
    assert_eq!(outcome(&forth), outcome(&back));
}
