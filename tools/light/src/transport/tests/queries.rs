//! Do queries weigh what they should, and is light that needs none told?

use super::super::lights::Lights;
use super::super::{GatherOptions, Method, Spread, Strata, Surfaces};
use super::pictures::{OPTIONS, rays, rays_with, total};
use super::scenes::{camera, shipped};
use glam::{DVec3, Vec3};
use pm_random::Random;

#[test]
fn a_pixels_weights_add_up_to_the_reflectance_it_sees() {
    // In a closed room no gather ray is lost, so the weights of a pixel sum to the wall's reflectance.
    let (scene, path) = shipped("furnace.obj");
    let (queries, ..) = rays(&scene, &path, 12, Strata::Raster);
    let mut sums = vec![[0f32; 3]; 24 * 20];
    for query in &queries {
        (0..3).for_each(|channel| sums[query.pixel as usize][channel] += query.weight[channel]);
    }
    assert_eq!(queries.len(), 24 * 20 * 12);
    for sum in sums {
        assert!((0..3).all(|i| (sum[i] - [0.2, 0.5, 0.8][i]).abs() < 1e-5), "{sum:?}");
    }
}

#[test]
fn pixel_and_sample_name_a_query_for_ever() {
    let (scene, path) = shipped("cornell.obj");
    let (raster, ..) = rays(&scene, &path, 9, Strata::Raster);
    let (shuffled, ..) = rays(&scene, &path, 9, Strata::Shuffled);
    let names = |queries: &[pm_formats::Query]| {
        let mut names: Vec<_> = queries.iter().map(|q| (q.pixel, q.sample, q.position.map(f32::to_bits))).collect();
        names.sort_unstable();
        names
    };
    let names_of_raster = names(&raster);
    assert!(names_of_raster.windows(2).all(|pair| (pair[0].0, pair[0].1) != (pair[1].0, pair[1].1)));
    assert_eq!(names_of_raster, names(&shuffled));
    assert_ne!(raster, shuffled);
}

#[test]
fn direct_light_of_the_diffuse_box_is_that_of_a_path_tracer() {
    // Irradiance straight from the light at points of the box (16 batches of 2^16 paths of an independent path tracer).
    let points = [
        ([0.0, 0.0, 0.40], Vec3::Y, [0.573_34, 0.445_93, 0.222_97]),
        ([0.0, 0.50, -0.50], Vec3::Z, [0.825_93, 0.642_39, 0.321_2]),
        ([-0.50, 0.50, 0.10], Vec3::X, [0.801_07, 0.623_06, 0.311_53]),
        ([-0.16, 0.60, -0.16], Vec3::Y, [2.957_6, 2.300_3, 1.150_2]),
        ([-0.48, 0.0, -0.48], Vec3::Y, [0.0, 0.0, 0.0]),
        ([0.35, 0.85, -0.50], Vec3::Z, [0.420_39, 0.326_97, 0.163_49]),
    ];
    let (scene, _) = shipped("cornell-diffuse.obj");
    let (surfaces, lights) = (Surfaces::new(&scene), Lights::new(&scene));
    for (position, normal, expected) in points {
        let position = Vec3::from(position);
        let point = surfaces.hit(position + normal * 1e-3, -normal).unwrap();
        let n = 20_000;
        let mut sum = DVec3::ZERO;
        for i in 0..n {
            let random = &mut Random::new(&[i]);
            sum += lights.reflected(&surfaces, &point, 16, random, |_, _| Vec3::ONE).as_dvec3() / n as f64;
        }
        for channel in 0..3 {
            let (found, expected) = (sum[channel], expected[channel]);
            assert!((found - expected).abs() < 0.004 * expected + 1e-4, "{position}: {sum} for {expected}");
        }
    }
}

#[test]
fn direct_visualisation_asks_once_at_each_point_seen_and_leaves_direct_light_to_the_map() {
    let (scene, path) = shipped("furnace.obj");
    let options = GatherOptions { method: Method::DirectVisualisation, ..OPTIONS };
    let (queries, light, _) = rays_with(&scene, camera(&path), options);
    assert_eq!(queries.len(), 24 * 20);
    assert!(queries.iter().all(|query| query.weight == [1.0; 3] && query.sample == 0));
    // The walls' own emission, once, and nothing of what they reflect.
    assert!(light.iter().all(|&light| light == Vec3::ONE));
}

#[test]
fn uniform_rays_carry_the_same_weight_in_the_mean() {
    let (scene, path) = shipped("furnace.obj");
    let weight = |spread| {
        let (queries, ..) = rays_with(&scene, camera(&path), GatherOptions { gathers: 64, spread, ..OPTIONS });
        total(&queries) / (24.0 * 20.0)
    };
    let (cosine, uniform) = (weight(Spread::Cosine), weight(Spread::Uniform));
    // The cosine's variance over an even hemisphere is 1/12; strata make it less.
    assert!((uniform / cosine - 1.0).abs().max_element() < 0.005, "{uniform} {cosine}");
}

#[test]
fn every_ray_of_a_pixel_has_a_number_of_its_own() {
    let (scene, path) = shipped("cornell.obj");
    let (queries, ..) = rays_with(&scene, camera(&path), GatherOptions { samples: 6, gathers: 4, ..OPTIONS });
    let mut names: Vec<_> = queries.iter().map(|query| (query.pixel, query.sample)).collect();
    names.sort_unstable();
    assert!(names.windows(2).all(|pair| pair[0] != pair[1]));
    let places: std::collections::BTreeSet<_> = queries.iter().map(|query| query.position.map(f32::to_bits)).collect();
    assert!(places.len() > queries.len() * 99 / 100, "samples of a pixel are not alike");
}

#[test]
fn short_rays_go_on_with_what_their_end_reflects() {
    // In the furnace every ray is continued if all are short: weights are then those of two reflections, and the lamps'
    // light at the first ends, 1 x rho^2, is in the base with what the walls reflect and emit themselves: the sum
    // 1 + rho + rho^2 + rho^2 x L of whatever the map then holds beyond.
    let (scene, path) = shipped("furnace.obj");
    let options = GatherOptions { gathers: 36, min_gather_dist: f32::MAX, light_samples: 64, ..OPTIONS };
    let (queries, light, _) = rays_with(&scene, camera(&path), options);
    let pixels = 24.0 * 20.0;
    let rho = DVec3::new(0.2, 0.5, 0.8);
    assert!((total(&queries) / pixels / (rho * rho) - 1.0).abs().max_element() < 1e-4);
    let base = light.iter().map(|light| light.as_dvec3()).sum::<DVec3>() / pixels;
    let expected = 1.0 + rho + rho * rho;
    // A shadow ray to one of twelve triangles around: noisy, and 17,280 of them.
    assert!((base / expected - 1.0).abs().max_element() < 0.02, "{base} for {expected}");

    // Between the two: rays that are continued are those that were short, the rest are untouched.
    let plain = rays_with(&scene, camera(&path), GatherOptions { gathers: 36, ..OPTIONS }).0;
    let some = rays_with(&scene, camera(&path), GatherOptions { gathers: 36, min_gather_dist: 0.2, ..OPTIONS }).0;
    let same = plain.iter().zip(&some).filter(|(a, b)| a == b).count();
    let share = same as f64 / plain.len() as f64;
    assert!((0.5..0.95).contains(&share), "{share}");
    assert!(plain.iter().zip(&some).all(|(a, b)| (a.pixel, a.sample) == (b.pixel, b.sample)));
}
