//! Do rays hit what they should, and is light neither lost nor made?

use super::*;
use crate::scene::{Camera, CameraOverrides, LoadOptions, Scene};
use glam::{DVec3, Vec3};
use pm_orders::{Generative, Leaves};
use pm_random::Random;
use std::path::{Path, PathBuf};

pub(super) fn shipped(name: &str) -> (Scene, PathBuf) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    (Scene::load(std::slice::from_ref(&path), &LoadOptions::default()).unwrap(), path)
}

pub(super) fn written(obj: &str, mtl: &str) -> Scene {
    written_with(obj, mtl, &LoadOptions::default())
}

fn written_with(obj: &str, mtl: &str, options: &LoadOptions) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.mtl"), mtl).unwrap();
    std::fs::write(folder.path().join("t.obj"), format!("mtllib t.mtl\n{obj}")).unwrap();
    Scene::load(&[folder.path().join("t.obj")], options).unwrap()
}

/// A box from `min` to `max` of one material, its faces turned outward or inward.
pub(super) fn cuboid(first_vertex: usize, min: f32, max: f32, material: &str, outward: bool) -> String {
    let mut text = String::new();
    for i in 0..8 {
        let side = |bit: usize| if i >> bit & 1 == 1 { max } else { min };
        text += &format!("v {} {} {}\n", side(0), side(1), side(2));
    }
    text += &format!("usemtl {material}\n");
    for face in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
        let mut face = face.map(|i| first_vertex + i);
        if !outward {
            face.reverse();
        }
        text += &format!("f {} {} {} {}\n", face[0], face[1], face[2], face[3]);
    }
    text
}

/// The first triangle by looking at all, in double precision: Möller and Trumbore, an independent method.
fn closest_by_brute_force(scene: &Scene, origin: Vec3, direction: Vec3) -> Option<f64> {
    let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
    let hit = |i: usize| {
        let [a, b, c] = scene.triangle(i).map(|p| p.as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let p = d.cross(ac);
        let determinant = ab.dot(p);
        let (s, q) = (o - a, (o - a).cross(ab));
        let (u, v, t) = (s.dot(p) / determinant, d.dot(q) / determinant, ac.dot(q) / determinant);
        (determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
    };
    (0..scene.triangle_count()).filter_map(hit).min_by(f64::total_cmp)
}

fn direction(random: &mut Random) -> Vec3 {
    let mut coordinate = || random.unit() * 2.0 - 1.0;
    Vec3::new(coordinate(), coordinate(), coordinate()).normalize_or(Vec3::X)
}

#[test]
fn rays_hit_what_looking_at_every_triangle_finds() {
    let (scene, _) = shipped("cornell.obj");
    let bvh = Bvh::build(&scene);
    let mut random = Random::new(&[11]);
    let mut hits = 0;
    for i in 0..20_000 {
        let origin = Vec3::new(random.unit() - 0.5, random.unit(), random.unit() - 0.5);
        let direction = match i % 4 {
            // Along the axes, with zeros of both signs: slabs of width 0 and divisions by 0.
            0 => [Vec3::X, Vec3::NEG_Y, Vec3::new(-0.0, 0.0, 1.0), Vec3::new(0.0, -1.0, -0.0)][i / 4 % 4],
            _ => direction(&mut random),
        };
        let expected = closest_by_brute_force(&scene, origin, direction);
        let found = bvh.closest(origin, direction, f32::INFINITY).map(|hit| f64::from(hit.t));
        match (found, expected) {
            (Some(found), Some(expected)) => {
                assert!((found - expected).abs() < 1e-5 * (1.0 + expected), "{origin} {direction}: {found} {expected}");
                hits += 1;
            }
            (None, None) => {}
            // Single and double precision may differ on which side of an outline a ray passes.
            other => {
                let nudged = direction + Vec3::new(1e-6, -1e-6, 1e-6);
                assert_ne!(
                    closest_by_brute_force(&scene, origin, nudged).is_some(),
                    expected.is_some(),
                    "{origin} {direction}: {other:?}"
                );
            }
        }
    }
    assert!(hits > 15_000);
}

#[test]
fn no_ray_slips_through_an_edge() {
    // From the middle of a closed cube every ray must hit: straight at corners, edges, and the diagonals of the faces.
    let (scene, _) = shipped("furnace.obj");
    let bvh = Bvh::build(&scene);
    let middle = Vec3::new(0.0, 0.5, 0.0);
    let n = 60i16;
    for i in -n..=n {
        for j in -n..=n {
            let (a, b) = (f32::from(i) / f32::from(n), f32::from(j) / f32::from(n));
            for target in [Vec3::new(1.0, a, b), Vec3::new(a, -1.0, b), Vec3::new(a, b, -1.0), Vec3::new(-1.0, b, a)] {
                assert!(bvh.closest(middle, target.normalize(), f32::INFINITY).is_some(), "{target}");
                assert!(bvh.blocked(middle, middle + target * 2.0), "{target}");
                assert!(!bvh.blocked(middle, middle + target * 0.49), "{target}");
            }
        }
    }
}

#[test]
fn hits_on_a_wall_lie_exactly_on_it_and_rays_from_it_leave_it() {
    let (scene, _) = shipped("furnace.obj");
    let stage = Stage::new(&scene);
    let mut random = Random::new(&[5]);
    for _ in 0..20_000 {
        let origin = Vec3::new(random.unit() - 0.5, random.unit(), random.unit() - 0.5) * 0.999 + Vec3::Y * 0.0005;
        let point = stage.hit(origin, direction(&mut random)).unwrap();
        let p = point.position;
        let on_wall = p.x.abs() == 0.5 || p.z.abs() == 0.5 || p.y == 0.0 || p.y == 1.0;
        assert!(on_wall, "{p}");
        // Back into the room, at any angle: never the wall itself, which would be at no distance.
        let mut onward = direction(&mut random);
        if onward.dot(point.facing) < 0.0 {
            onward = -onward;
        }
        let next = stage.hit(point.start(onward), onward).expect("the room is closed");
        assert!(next.position.distance(p) > 1e-6 || onward.dot(point.facing) < 1e-4, "{p} {onward}");
    }
}

/// Flux that photons bring to surfaces, and its standard error from batches of paths, as a fraction of what is emitted;
/// per material name and channel.
fn incident(scene: &Scene, paths: u64, class: impl Fn(&PathPhoton) -> usize, classes: usize) -> Vec<[(f64, f64); 3]> {
    const BATCHES: u64 = 32;
    let tracer = PhotonPaths::new(scene, 1);
    let emitted = scene.emitted_flux();
    let mut sums = vec![[[0f64; BATCHES as usize]; 3]; classes];
    for path in 0..paths {
        tracer.trace(path, |photon| {
            for channel in 0..3 {
                let share = f64::from(photon.power[channel]) / emitted[channel] * BATCHES as f64 / paths as f64;
                sums[class(&photon)][channel][(path % BATCHES) as usize] += share;
            }
        });
    }
    let statistics = |batches: [f64; BATCHES as usize]| {
        let n = BATCHES as f64;
        let mean = batches.iter().sum::<f64>() / n;
        let variance = batches.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
        (mean, (variance / n).sqrt())
    };
    sums.into_iter().map(|channels| channels.map(statistics)).collect()
}

fn assert_within_errors(found: [(f64, f64); 3], expected: [f64; 3], what: &str) {
    for channel in 0..3 {
        let (mean, error) = found[channel];
        // Four standard errors: one check in 16,000 fails by chance, and the seed is fixed.
        assert!(error < 0.03 * expected[channel].max(0.05), "{what}: error {error}");
        assert!(
            (mean - expected[channel]).abs() < 4.0 * error + 1e-4,
            "{what} {channel}: {mean} +- {error}, {expected:?}"
        );
    }
}

#[test]
fn in_a_furnace_incident_flux_is_a_geometric_series() {
    // All light is caught again: incident / emitted = 1 / (1 - rho), for three reflectances at once. A roulette that does
    // not make up per channel, or a cap on depth, fails in blue, where it takes over 20 bounces.
    let (scene, _) = shipped("furnace.obj");
    let found = incident(&scene, 100_000, |_| 0, 1);
    assert_within_errors(found[0], [1.25, 2.0, 5.0], "furnace");
}

#[test]
fn mirrors_and_glass_in_a_furnace_neither_make_nor_swallow_light() {
    let mtl = "newmtl wall\nKd 0.2 0.5 0.8\nKe 1 1 1\nillum 1\n\
               newmtl glass\nNi 1.5\nTf 1 1 1\nillum 7\nnewmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 3\n";
    for body in ["glass", "mirror"] {
        let obj = cuboid(1, -1.0, 1.0, "wall", false) + &cuboid(9, -0.4, 0.4, body, true);
        let scene = written(&obj, mtl);
        let found = incident(&scene, 100_000, |_| 0, 1);
        assert_within_errors(found[0], [1.25, 2.0, 5.0], body);
    }
}

#[test]
fn a_tinted_mirror_takes_its_share() {
    // A closed box, half of whose walls are a mirror that keeps 90 %, the rest black-ish: compared with a closed form for
    // the infinite corridor of two facing plates would need the plates to be infinite; instead the balance is checked:
    // what arrives at diffuse walls minus what they send back, plus what mirrors swallow, is what was emitted.
    let mtl = "newmtl wall\nKd 0.5 0.5 0.5\nKe 1 1 1\nillum 1\nnewmtl mirror\nKd 0 0 0\nKs 0.5 0.5 0.5\nillum 3\n";
    let obj = cuboid(1, -1.0, 1.0, "wall", false) + &cuboid(9, -0.5, 0.5, "mirror", true);
    let scene = written(&obj, mtl);
    let found = incident(&scene, 100_000, |_| 0, 1);
    // Radiosity of two grey bodies, one inside the other: F = A1 / A2 = 1/4 of the walls' light meets the inner cube and
    // half of that comes back. Incident = emitted + rho incident of which 1 - F / 2 arrives: x = 0.875 (1 + 0.5 x).
    let expected = 0.875 / (1.0 - 0.5 * 0.875);
    let (mean, error) = found[0][0];
    // The inner cube is flat-sided: light is not quite evenly spread, but the room is convex and its walls alike.
    assert!((mean / expected - 1.0).abs() < 0.02 + 4.0 * error, "{mean} +- {error}, {expected}");
}

#[test]
fn fluxes_of_the_diffuse_box_are_those_of_an_independent_particle_tracer() {
    // Incident flux / emitted flux, 16 x 2^20 photons of a particle tracer that shares no code with this project.
    let expected = [
        ("floor", [0.134_921 + 0.084_703_6, 0.134_919 + 0.076_523_4, 0.134_919 + 0.049_068_3]),
        ("back", [0.171_928 + 0.132_842, 0.171_926 + 0.120_507, 0.171_926 + 0.079_515_2]),
        ("left", [0.172_627 + 0.129_979, 0.172_625 + 0.108_18, 0.172_625 + 0.083_870_4]),
        ("right", [0.191_432 + 0.142_343, 0.191_43 + 0.130_524, 0.191_43 + 0.102_102]),
        ("ceiling", [0.171_79, 0.150_899, 0.115_646]),
    ];
    let (scene, _) = shipped("cornell-diffuse.obj");
    let wall = |photon: &PathPhoton| {
        let p = photon.position;
        let on = [p.y == 0.0, p.z == -0.5, p.x == -0.5, p.x == 0.5, p.y == 1.0];
        on.iter().position(|&on| on).unwrap_or(5)
    };
    let found = incident(&scene, 400_000, wall, 6);
    for ((name, expected), found) in expected.into_iter().zip(found) {
        assert_within_errors(found, expected, name);
    }
}

#[test]
fn packing_keeps_the_sum_of_powers() {
    let (scene, _) = shipped("cornell-diffuse.obj");
    let paths = PhotonPaths::new(&scene, 3);
    let (mut exact, mut packed, mut id) = ([0f64; 3], [0f64; 3], 0);
    for path in 0..50_000 {
        paths.trace(path, |photon| {
            let power = paths.pack(id, &photon).unwrap().power();
            for channel in 0..3 {
                exact[channel] += f64::from(photon.power[channel]);
                packed[channel] += power[channel];
            }
            id += 1;
        });
    }
    for channel in 0..3 {
        // Each rounding is off by at most 1/128; their mean by 1/128 / sqrt(12 n).
        assert!((packed[channel] / exact[channel] - 1.0).abs() < 2e-4, "{packed:?} {exact:?}");
    }
}

fn rays(scene: &Scene, path: &Path, gathers: u32, strata: Strata) -> (Vec<pm_formats::Query>, Vec<Vec3>, Camera) {
    let overrides = CameraOverrides { size: Some([24, 20]), ..CameraOverrides::default() };
    let camera = Camera::find(&[path.to_owned()], &scene.bounds, &overrides).unwrap().camera;
    rays_with(scene, camera, GatherOptions { gathers, strata, ..OPTIONS })
}

pub(super) const OPTIONS: GatherOptions = GatherOptions {
    method: Method::FinalGather,
    samples: 1,
    gathers: 1,
    spread: Spread::Cosine,
    min_gather_dist: 0.0,
    light_samples: 4,
    seed: 9,
    direct: true,
    strata: Strata::Raster,
    caustics: true,
};

fn rays_with(scene: &Scene, camera: Camera, options: GatherOptions) -> (Vec<pm_formats::Query>, Vec<Vec3>, Camera) {
    let rays = GatherRays::new(scene, camera, options);
    let (mut queries, mut light) = (vec![], vec![Vec3::ZERO; 24 * 20]);
    let mut counts = RayCounts::default();
    for y in 0..20 {
        for x in 0..24 {
            let pixel = (y * 24 + x) as usize;
            rays.visits().pixel(
                [x, y],
                Leaves::All,
                None,
                |query| queries.push(query),
                |l| light[pixel] += l,
                &mut counts,
            );
        }
    }
    if options.method == Method::FinalGather {
        assert_eq!(counts.gather - counts.gather_lost, queries.len() as u64);
    }
    (queries, light, camera)
}

#[test]
fn a_pixel_that_is_remembered_is_seen_as_at_first() {
    // The box with a mirror and a glass sphere, in passes that come to each pixel again, and from the second one on.
    let (scene, path) = shipped("cornell.obj");
    let overrides = CameraOverrides { size: Some([24, 20]), ..CameraOverrides::default() };
    let camera = Camera::find(&[path], &scene.bounds, &overrides).unwrap().camera;
    let rays = GatherRays::new(&scene, camera, GatherOptions { gathers: 4, ..OPTIONS }).with_bins(4);
    let order = Generative::DirectionBinned { tile: 32, bins: 4 };
    for first in [0, 1] {
        let mut visits = rays.visits();
        for pass in order.passes().skip(first) {
            let (mut remembered, mut afresh) =
                ((vec![], vec![], RayCounts::default()), (vec![], vec![], RayCounts::default()));
            for (x, y) in (0..20).flat_map(|y| (0..24).map(move |x| (x, y))) {
                let (queries, light, counts) = &mut remembered;
                visits.pixel([x, y], pass, None, |query| queries.push(query), |l| light.push(l), counts);
                let (queries, light, counts) = &mut afresh;
                rays.visits().pixel([x, y], pass, None, |query| queries.push(query), |l| light.push(l), counts);
            }
            assert_eq!(remembered, afresh, "{pass:?}");
            assert!(!afresh.0.is_empty() && (pass.bin > 0 || !afresh.1.is_empty()));
        }
    }
}

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
    let (stage, lights) = (Stage::new(&scene), lights::Lights::new(&scene));
    for (position, normal, expected) in points {
        let position = Vec3::from(position);
        let point = stage.hit(position + normal * 1e-3, -normal).unwrap();
        let n = 20_000;
        let mut sum = DVec3::ZERO;
        for i in 0..n {
            let random = &mut Random::new(&[i]);
            sum += lights.reflected(&stage, &point, 16, random, |_| Vec3::ONE).as_dvec3() / n as f64;
        }
        for channel in 0..3 {
            let (found, expected) = (sum[channel], expected[channel]);
            assert!((found - expected).abs() < 0.004 * expected + 1e-4, "{position}: {sum} for {expected}");
        }
    }
}

fn camera(path: &Path) -> Camera {
    let (scene, overrides) = (Scene::load(&[path.to_owned()], &LoadOptions::default()).unwrap(), [24, 20]);
    let overrides = CameraOverrides { size: Some(overrides), ..CameraOverrides::default() };
    Camera::find(&[path.to_owned()], &scene.bounds, &overrides).unwrap().camera
}

/// Sum over all pixels of the queries' weights.
fn total(queries: &[pm_formats::Query]) -> glam::DVec3 {
    queries.iter().map(|query| Vec3::from(query.weight).as_dvec3()).sum()
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

/// Where in the image a point is seen, in pixels: the camera's definition turned round.
fn project(camera: &Camera, point: Vec3) -> (f64, f64) {
    let forward = (camera.look_at() - camera.eye()).normalize();
    let right = forward.cross(camera.up()).normalize();
    let way = point - camera.eye();
    let [width, height] = camera.size().map(f64::from);
    let scale = height / 2.0 / f64::tan(camera.vfov().to_radians() / 2.0) / f64::from(way.dot(forward));
    let up = right.cross(forward);
    (width / 2.0 + f64::from(way.dot(right)) * scale, height / 2.0 - f64::from(way.dot(up)) * scale)
}

#[test]
fn samples_share_the_pixel_and_stay_in_it() {
    // Seen straight on, the position on the back wall tells where in the pixel a ray went: one in each cell of the grid.
    let (scene, path) = shipped("furnace.obj");
    let options = GatherOptions { method: Method::DirectVisualisation, samples: 6, ..OPTIONS };
    let (queries, light, camera) = rays_with(&scene, camera(&path), options);
    assert!(light.iter().all(|&light| (light - 1.0).abs().max_element() < 1e-6));
    let mut cells = std::collections::BTreeSet::new();
    for query in queries.iter().filter(|query| query.position[2] == -0.5) {
        assert!((query.weight[0] - 1.0 / 6.0).abs() < 1e-6);
        let (x, y) = project(&camera, Vec3::from(query.position));
        let (dx, dy) = (x - f64::from(query.pixel % 24), y - f64::from(query.pixel / 24));
        assert!((-1e-4..1.0001).contains(&dx) && (-1e-4..1.0001).contains(&dy), "{dx} {dy}");
        cells.insert((query.pixel, (dx * 2.999_99) as u32 + 3 * (dy * 1.999_99) as u32));
    }
    let pixels: std::collections::BTreeSet<_> = cells.iter().map(|cell| cell.0).collect();
    // Rounding may move a sample at a cell's border; pixels at the wall's own border are shared with other walls.
    assert!(cells.len() * 20 > pixels.len() * 6 * 17, "{} cells in {} pixels", cells.len(), pixels.len());
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

#[test]
fn a_glossy_body_in_a_furnace_neither_makes_nor_swallows_light() {
    // Kd + Ks = 1. A lobe so sharp loses some 0.6 / sqrt(n) of diffuse light: 0.04 % of what there is in the room.
    let mtl = "newmtl wall\nKd 0.2 0.5 0.8\nKe 1 1 1\nillum 1\n\
               newmtl paint\nKd 0.4 0.4 0.4\nKs 0.6 0.6 0.6\nNs 30000\nillum 2\n";
    let obj = cuboid(1, -1.0, 1.0, "wall", false) + &cuboid(9, -0.4, 0.4, "paint", true);
    let scene = written_with(&obj, mtl, &LoadOptions { glossy: true, ..LoadOptions::default() });
    assert!(scene.materials.iter().any(|material| material.specular == [0.6; 3] && material.exponent == 30000.0));
    let on_wall = |photon: &PathPhoton| usize::from(photon.position.abs().max_element() < 0.999);
    let found = incident(&scene, 100_000, on_wall, 2);
    // The walls catch what they emit and each other's reflections, wherever the body sends them.
    assert_within_errors(found[0], [1.25, 2.0, 5.0], "glossy");
    // And the body sees as much as anything of its area: flux = area ratio x that of the walls (both convex).
    assert_within_errors(found[1], [0.16 * 1.25, 0.16 * 2.0, 0.16 * 5.0], "body");
}

#[test]
fn gather_rays_of_glossy_points_carry_the_albedo() {
    // A wall of paint seen from inside a closed cube: along the normal the weights add up to Kd + Ks.
    let mtl = "newmtl paint\nKd 0.2 0.3 0.1\nKs 0.4 0.2 0.6\nNs 40\nillum 2\nnewmtl lamp\nKe 1 1 1\n";
    let obj = cuboid(1, -1.0, 1.0, "paint", false) + &cuboid(9, 2.0, 2.1, "lamp", true);
    let scene = written_with(&obj, mtl, &LoadOptions { glossy: true, ..LoadOptions::default() });
    let view = CameraOverrides {
        eye: Some([0.0, 0.0, 0.5]),
        look_at: Some([0.0, 0.0, -1.0]),
        vfov: Some(2.0),
        size: Some([24, 20]),
        ..CameraOverrides::default()
    };
    let camera = Camera::find(&[PathBuf::from("none.obj")], &scene.bounds, &view).unwrap().camera;
    for spread in [Spread::Cosine, Spread::Uniform] {
        let options = GatherOptions { gathers: 100, spread, ..OPTIONS };
        let found = total(&rays_with(&scene, camera, options).0) / (24.0 * 20.0);
        // The second surfaces are glossy too: queries, as on the first.
        let expected = DVec3::new(0.6, 0.5, 0.7);
        assert!((found - expected).abs().max_element() < 0.005, "{spread:?}: {found}");
    }
}

#[test]
fn caustics_are_what_came_by_mirrors_and_glass_alone() {
    let (scene, _) = shipped("cornell.obj");
    let paths = PhotonPaths::new(&scene, 1);
    let (mut caustic, mut all) = (0, 0);
    for path in 0..20_000 {
        let mut first = true;
        paths.trace(path, |photon| {
            // A path has one caustic photon at most, and it is the first that is stored.
            assert!(!photon.caustic || first);
            first = false;
            caustic += u32::from(photon.caustic);
            all += 1;
        });
    }
    assert!(caustic > 500 && caustic * 5 < all, "{caustic} of {all}");
    let (diffuse, _) = shipped("cornell-diffuse.obj");
    let paths = PhotonPaths::new(&diffuse, 1);
    (0..2000).for_each(|path| paths.trace(path, |photon| assert!(!photon.caustic)));
}
