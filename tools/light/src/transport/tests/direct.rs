//! Is light straight from the lamps right, and with little noise whether lamps are small, close by or all around?

use super::super::GatherOptions;
use super::super::direct::{Techniques, direct_light};
use super::super::gather_path::{GatherPaths, PathRandom};
use super::super::lights::Lights;
use super::super::ray_counts::RayCounts;
use super::super::reflection::{Reflection, Spread};
use super::super::surface::{SurfacePoint, Surfaces};
use super::pictures::{OPTIONS, rays_with};
use super::scenes::{camera, cuboid, shipped, written_with};
use crate::scene::{LoadOptions, Scene};
use glam::Vec3;
use pm_random::Random;

const POLISHED: &str =
    "newmtl floor\nKd 0 0 0\nKs 0.6 0.6 0.6\nNs 500\nillum 2\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\nillum 1\n";
const PAINTED: &str =
    "newmtl floor\nKd 0.3 0.3 0.3\nKs 0.5 0.5 0.5\nNs 20\nillum 2\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\nillum 1\n";

const MATT: &str = "newmtl floor\nKd 0.3 0.3 0.3\nillum 1\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\nillum 1\n";

const FLOOR: &str = "v -.5 0 -.5\nv -.5 0 .5\nv .5 0 .5\nv .5 0 -.5\nusemtl floor\nf -4 -3 -2 -1\n";

/// A floor in the middle of a closed cube that glows all around.
fn cavity(mtl: &str) -> Scene {
    let obj = FLOOR.to_owned() + &cuboid(5, -1.0, 1.0, "lamp", false);
    written_with(&obj, mtl, &LoadOptions { glossy: true, ..LoadOptions::default() })
}

/// A floor below a square lamp that faces it.
fn below_a_lamp(mtl: &str, half_side: f32) -> Scene {
    let [x, y] = [half_side, 0.6];
    let lamp = format!("v {x} {y} -{x}\nv {x} {y} {x}\nv -{x} {y} {x}\nv -{x} {y} -{x}\nusemtl lamp\nf -4 -3 -2 -1\n");
    written_with(&(FLOOR.to_owned() + &lamp), mtl, &LoadOptions { glossy: true, ..LoadOptions::default() })
}

/// Mean, its standard error, and the standard deviation of one estimate of what the floor reflects towards `view`.
fn measure(
    scene: &Scene,
    view: Vec3,
    estimate: impl Fn(&Surfaces<'_>, &Lights, &SurfacePoint, &Reflection, &mut Random) -> Vec3,
) -> [f64; 3] {
    let (surfaces, lights) = (Surfaces::new(scene), Lights::new(scene));
    let point = surfaces.hit(Vec3::new(0.02, 0.1, 0.03), Vec3::NEG_Y).unwrap();
    let reflection = Reflection::new(surfaces.material(&point), point.facing, view.normalize());
    let n = 40_000u64;
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..n {
        let value = f64::from(estimate(&surfaces, &lights, &point, &reflection, &mut Random::new(&[i])).y);
        sum += value;
        squares += value * value;
    }
    let mean = sum / n as f64;
    let deviation = (squares / n as f64 - mean * mean).sqrt();
    [mean, deviation / (n as f64).sqrt(), deviation]
}

fn both(scene: &Scene, view: Vec3, samples: u32) -> [f64; 3] {
    measure(scene, view, |surfaces, lights, point, reflection, random| {
        direct_light(surfaces, lights, point, reflection, Techniques { shadow: samples, gather: 0 }, random)
    })
}

fn by_lamps_alone(scene: &Scene, view: Vec3) -> [f64; 3] {
    measure(scene, view, |surfaces, lights, point, reflection, random| {
        lights.reflected(surfaces, point, 1, random, |towards, _| reflection.brdf(towards))
    })
}

#[test]
fn a_polished_floor_in_an_even_cavity_reflects_its_share_with_little_noise() {
    // Seen along the normal it reflects Ks of a radiance of 1.
    let scene = cavity(POLISHED);
    for samples in [1, 4] {
        let [mean, error, deviation] = both(&scene, Vec3::Y, samples);
        assert!((mean - 0.6).abs() < 4.0 * error && error < 0.002, "{samples}: {mean} +- {error}");
        // Lamps alone: more than three times the mean.
        assert!(deviation < 0.2 * mean, "{samples}: {deviation} of {mean}");
    }
    let [mean, error, deviation] = by_lamps_alone(&scene, Vec3::Y);
    assert!((mean - 0.6).abs() < 4.0 * error && deviation > 3.0 * mean, "{mean} {deviation}");
}

#[test]
fn what_is_reflected_is_the_same_by_lamps_alone() {
    // Lamps that are smaller than the lobe, as large, and larger; seen from above and along the floor.
    for mtl in [POLISHED, PAINTED] {
        for half_side in [0.002, 0.05, 0.5] {
            for view in [Vec3::Y, Vec3::new(0.1, 1.0, -0.05), Vec3::new(-1.0, 0.8, 0.3)] {
                let scene = below_a_lamp(mtl, half_side);
                let [mean, error, deviation] = both(&scene, view, 1);
                let [expected, its_error, its_deviation] = by_lamps_alone(&scene, view);
                let what = format!("lamp {half_side}, view {view}: {mean} +- {error}, {expected} +- {its_error}");
                assert!((mean - expected).abs() <= 4.0 * error.hypot(its_error) + 1e-5 * expected, "{what}");
                // What the balance heuristic may cost where one technique would do alone (Veach, thesis, theorem 9.2).
                let most = its_deviation.hypot(expected * 0.5f64.sqrt());
                assert!(deviation <= most, "{what}: {deviation}, {its_deviation}");
            }
        }
    }
}

#[test]
fn shadow_rays_and_gather_rays_share_the_light_of_lamps_small_and_close() {
    let options = GatherOptions { light_samples: 2, gathers: 3, ..OPTIONS };
    for half_side in [0.002, 0.05, 0.5, 5.0] {
        let scene = below_a_lamp(MATT, half_side);
        let paths = GatherPaths::new((&scene).into(), options);
        let techniques = Techniques { shadow: 2, gather: 3 };
        let [mean, error, deviation] = measure(&scene, Vec3::Y, |surfaces, lights, point, reflection, random| {
            let mut sum = direct_light(surfaces, lights, point, reflection, techniques, random);
            for _ in 0..techniques.gather {
                let (u, v) = (random.unit(), random.unit());
                let (direction, weight) = reflection.sample(Spread::Cosine, None, u, v, random).unwrap();
                let weight = weight / techniques.gather as f32;
                let own = || Random::new(&[1]);
                let random = &mut PathRandom { path: own(), light_at_short_end: own };
                let counts = &mut RayCounts::default();
                paths.cast(point, (direction, techniques), weight, random, &mut |light| sum += light, counts);
            }
            sum
        });
        let [expected, its_error, its_deviation] = by_lamps_alone(&scene, Vec3::Y);
        let what = format!("lamp {half_side}: {mean} +- {error}, {expected} +- {its_error}");
        assert!((mean - expected).abs() <= 4.0 * error.hypot(its_error) + 1e-5 * expected, "{what}");
        // What the balance heuristic may cost where one technique would do alone (Veach, thesis, theorem 9.2).
        assert!(deviation <= its_deviation.hypot(expected * 0.5f64.sqrt()), "{what}: {deviation}, {its_deviation}");
    }
}

#[test]
fn walls_that_glow_light_one_another_without_noise() {
    // In the furnace each wall emits 1, and reflects its share of the 1 that comes to it from everywhere; four shadow rays
    // alone scatter by five times that in the mean over the picture, for its edges.
    let (scene, path) = shipped("furnace.obj");
    let (_, light, _) = rays_with(&scene, camera(&path), GatherOptions { gathers: 4, ..OPTIONS });
    let rho = Vec3::new(0.2, 0.5, 0.8);
    let off = |light: &Vec3| ((*light - 1.0) / rho - 1.0).as_dvec3().y;
    let n = light.len() as f64;
    let mean = light.iter().map(off).sum::<f64>() / n;
    let deviation = (light.iter().map(|light| off(light).powi(2)).sum::<f64>() / n).sqrt();
    assert!(mean.abs() < 0.02 && deviation < 0.2, "{mean} {deviation}");
}
