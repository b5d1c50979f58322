//! Are guided directions distributed as they claim, is the mean kept, and does the noise fall?

use super::super::reflection::{Reflection, Spread};
use super::super::sampling::uniform_direction;
use super::super::tests::{OPTIONS, cuboid, shipped, written};
use super::super::{GatherRays, Method, PhotonPaths, RayCounts};
use super::*;
use crate::scene::{Camera, CameraOverrides, Material, Scene};
use pm_orders::Leaves;
use pm_random::Random;
use std::path::PathBuf;

/// Distributions of light from many directions, from one, from grazing ones, about several normals.
fn distributions() -> Vec<Directions> {
    let mut random = Random::new(&[21]);
    let mut made = vec![];
    for normal in [Vec3::Y, Vec3::NEG_Z, Vec3::new(1.0, -2.0, 0.5).normalize(), Vec3::new(-0.3, 0.2, 0.9).normalize()] {
        let (x, _) = frame(normal);
        let few: Vec<_> = (0..7).map(|i| uniform_direction(normal, random.unit(), i as f32 / 7.0)).collect();
        let many: Vec<_> = (0..3000).map(|_| uniform_direction(normal, random.unit(), random.unit())).collect();
        let grazing = vec![(x + normal * 0.01).normalize()];
        for directions in [vec![normal], few, many, grazing] {
            let light = directions.into_iter().map(|direction| (direction, random.unit() + 0.1)).collect::<Vec<_>>();
            // Light from below is no light.
            made.push(Directions::new(normal, light.into_iter().chain([(-normal, 1e6)])).unwrap());
        }
    }
    made
}

/// Chance of each of `8 x 16` cells of equal solid angle, by midpoint sums of the density over the hemisphere.
fn chances(directions: &Directions) -> Vec<f64> {
    // Rows of the grid end between these elevations, columns at these azimuths.
    let fine = [800, 4];
    let mut sums = vec![0.0; 128];
    let n = [8 * fine[0], 16 * fine[1]];
    for i in 0..n[0] {
        for j in 0..n[1] {
            let u = (i as f32 + 0.5) / n[0] as f32;
            let direction = uniform_direction(directions.normal, u, (j as f32 + 0.5) / n[1] as f32);
            // Uniform over the hemisphere: 2 pi / (number of points) steradians each.
            let density = f64::from(directions.density(direction) * direction.dot(directions.normal)) * 2.0;
            sums[(i / fine[0]) * 16 + j / fine[1]] += density / (n[0] * n[1]) as f64;
        }
    }
    sums
}

#[test]
fn densities_integrate_to_one_over_the_hemisphere() {
    let mut random = Random::new(&[3]);
    for directions in distributions() {
        let total: f64 = chances(&directions).iter().sum();
        assert!((total - 1.0).abs() < 2e-3, "{total}");
        for _ in 0..1000 {
            let density = directions.density(uniform_direction(directions.normal, random.unit(), random.unit()));
            // Every direction can be met, and none weighs more than twice what it would by the cosine.
            assert!(density >= COSINE_SHARE * 0.999, "{density}");
        }
    }
}

#[test]
fn samples_are_distributed_as_the_density_says() {
    let mut random = Random::new(&[4]);
    for directions in distributions() {
        let n = 100_000;
        let mut counts = vec![0.0; 128];
        let mut differing = 0;
        for _ in 0..n {
            let (direction, density) = directions.sample(random.unit(), random.unit());
            differing += u32::from((density / directions.density(direction) - 1.0).abs() > 1e-3);
            let cosine = direction.dot(directions.normal);
            let (_, v) = unit_square(directions.normal, direction);
            counts[((1.0 - cosine) * 8.0).min(7.0) as usize * 16 + ((v * 16.0) as usize).min(15)] += 1.0;
        }
        // Rounding may put a sample across the border of a cell.
        assert!(differing < n / 1000, "{differing}");
        let expected = chances(&directions);
        let square: f64 =
            counts.iter().zip(&expected).map(|(o, e)| (o - e * f64::from(n)).powi(2) / (e * f64::from(n))).sum();
        // Chi-square of 127 degrees of freedom: mean 127, deviation 16; the midpoint sums add a little.
        assert!(square < 127.0 + 6.0 * 16.0, "{square}");
    }
}

#[test]
fn strata_stay_strata() {
    for directions in distributions() {
        let mut before = 0.0;
        for i in 0..=1000u16 {
            let (_, u, density) = stretched(&directions.rows, f32::from(i) / 1001.0);
            assert!(u >= before && u <= 1.0 && density >= COSINE_SHARE * 0.999);
            before = u;
        }
    }
}

#[test]
fn a_guided_glossy_surface_reflects_what_the_integral_of_its_brdf_says() {
    let paint = Material::lambert("m", [0.3, 0.2, 0.0]);
    let paint = Material { kind: MaterialKind::Glossy, specular: [0.1, 0.5, 0.9], exponent: 20.0, ..paint };
    let mut random = Random::new(&[5]);
    for guide in distributions() {
        let reflection = Reflection::new(&paint, guide.normal, guide.normal);
        let n = 60_000;
        let mut mean = glam::DVec3::ZERO;
        for _ in 0..n {
            let (u, v) = (random.unit(), random.unit());
            let sample = reflection.sample(Spread::Cosine, Some(&guide), u, v, &mut random);
            mean += sample.map_or(Vec3::ZERO, |(_, weight)| weight).as_dvec3() / f64::from(n);
        }
        // Along the normal: diffuse + specular.
        assert!((mean - glam::DVec3::new(0.4, 0.7, 0.9)).abs().max_element() < 0.012, "{mean}");
    }
}

/// Photons of the first paths through a scene, and how many of them had been reflected before.
fn photons(scene: &Scene, paths: u64) -> (Vec<Photon>, usize) {
    let tracer = PhotonPaths::new(scene, 1);
    let (mut photons, mut indirect) = (vec![], 0);
    for path in 0..paths {
        let mut first = true;
        tracer.trace(path, |photon| {
            photons.push(tracer.pack(photons.len() as u64, &photon).unwrap());
            indirect += usize::from(!first);
            first = false;
        });
    }
    (photons, indirect)
}

#[test]
fn photons_straight_from_a_lamp_do_not_guide() {
    // Of diffuse surfaces only: all photons of a path but its first have been reflected.
    let (scene, _) = shipped("cornell-diffuse.obj");
    let (photons, indirect) = photons(&scene, 20_000);
    let guide = Guide::new(&Stage::new(&scene), &photons);
    let kept = guide.len() as f64 / indirect as f64;
    // A few come from beside the lamp, which a packed direction cannot tell from it.
    assert!((0.97..1.005).contains(&kept), "{kept}");
    assert!(photons.len() > 2 * indirect - indirect / 2);
}

/// A closed room whose lamp shines down on a patch of the floor from near by: the walls get their light from there.
fn spot() -> (Scene, Camera) {
    let mtl = "newmtl wall\nKd 0.4 0.4 0.4\nnewmtl lamp\nKd 0 0 0\nKe 50 50 50\n";
    let lamp = "v -.1 -.7 -.1\nv .1 -.7 -.1\nv .1 -.7 .1\nv -.1 -.7 .1\nusemtl lamp\nf 9 10 11 12\n";
    let scene = written(&(cuboid(1, -1.0, 1.0, "wall", false) + lamp), mtl);
    let view = CameraOverrides {
        eye: Some([0.9, 0.5, 0.0]),
        look_at: Some([-1.0, 0.4, 0.0]),
        vfov: Some(60.0),
        size: Some([24, 20]),
        ..CameraOverrides::default()
    };
    let camera = Camera::find(&[PathBuf::from("none.obj")], &scene.bounds, &view).unwrap().camera;
    (scene, camera)
}

/// What each pixel gets of a patch of the floor that has radiance 1 where all else is dark.
fn of_the_patch(rays: &GatherRays<'_>, counts: &mut RayCounts) -> Vec<f64> {
    let mut pixels = vec![0.0; 24 * 20];
    for y in 0..20 {
        for x in 0..24 {
            let query = |query: pm_formats::Query| {
                let [x, y, z] = query.position;
                if y == -1.0 && x.abs().max(z.abs()) < 0.3 {
                    pixels[query.pixel as usize] += f64::from(query.weight[0]);
                }
            };
            rays.visits().pixel([x, y], Leaves::All, None, query, |_| {}, counts);
        }
    }
    pixels
}

#[test]
fn light_from_few_directions_comes_with_less_noise_and_no_other_mean() {
    let (scene, camera) = spot();
    let (photons, _) = photons(&scene, 150_000);
    const SEEDS: u64 = 12;
    // Per seed: the mean over the pixels. Over all: the variance of a pixel.
    let measure = |guided: bool, gathers: u32| {
        let mut counts = RayCounts::default();
        let pictures: Vec<Vec<f64>> = (0..SEEDS)
            .map(|seed| {
                let options = super::super::GatherOptions { gathers, seed, direct: false, ..OPTIONS };
                let rays = GatherRays::new(&scene, camera, options);
                let rays = if guided { rays.guided_by(&photons) } else { rays };
                of_the_patch(&rays, &mut counts)
            })
            .collect();
        assert!(if guided { counts.guided * 10 > counts.seen * 9 } else { counts.guided == 0 }, "{counts:?}");
        let means: Vec<f64> = pictures.iter().map(|p| p.iter().sum::<f64>() / p.len() as f64).collect();
        let spread = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            (mean, values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (values.len() - 1) as f64)
        };
        let pixels = pictures[0].len();
        let variance: f64 =
            (0..pixels).map(|i| spread(&pictures.iter().map(|p| p[i]).collect::<Vec<_>>()).1).sum::<f64>()
                / pixels as f64;
        let (mean, of_means) = spread(&means);
        (mean, of_means / SEEDS as f64, variance)
    };
    let (cosine, guided) = (measure(false, 16), measure(true, 16));
    assert!(guided.2 < 0.5 * cosine.2, "variance {} by the guide, {} by the cosine", guided.2, cosine.2);
    let known = measure(false, 400);
    let error = (known.1 + guided.1).sqrt();
    assert!(error < 0.02 * known.0 && (known.0 - guided.0).abs() < 4.0 * error, "{known:?} {guided:?}");
}

#[test]
fn without_photons_nothing_changes() {
    let (scene, path) = shipped("cornell-diffuse.obj");
    let overrides = CameraOverrides { size: Some([24, 20]), ..CameraOverrides::default() };
    let camera = Camera::find(&[path], &scene.bounds, &overrides).unwrap().camera;
    let options = super::super::GatherOptions { gathers: 4, method: Method::FinalGather, ..OPTIONS };
    let queries = |guide: Option<&[Photon]>| {
        let rays = GatherRays::new(&scene, camera, options);
        let rays = guide.into_iter().fold(rays, GatherRays::guided_by);
        let mut queries = vec![];
        rays.visits().pixel([12, 7], Leaves::All, None, |query| queries.push(query), |_| {}, &mut RayCounts::default());
        queries
    };
    assert_eq!(queries(None), queries(Some(&[])));
    let (some, _) = photons(&scene, 60_000);
    let guided = queries(Some(&some));
    assert_ne!(queries(None), guided);
    // The same names, in the same order.
    assert!(queries(None).iter().all(|query| query.pixel == guided[0].pixel));
}
