//! Is the mean kept, and does the noise fall?

use super::super::tests::pictures::OPTIONS;
use super::super::tests::scenes::{cuboid, shipped, written};
use super::super::{GatherOptions, GatherRays, Method, PhotonPaths, PixelCaster, RayCounts};
use super::*;
use crate::scene::{Camera, CameraOverrides, FileSystem, Scene};
use pm_orders::VisiblePoints;
use std::path::PathBuf;

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
    let guide = Guide::new(&Surfaces::new(&scene), &photons);
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
    let camera = Camera::find(&[PathBuf::from("none.obj")], &scene, &view, &FileSystem).unwrap().camera;
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
            PixelCaster::new(rays, None).pixel([x, y], VisiblePoints::All, query, |_| {}, counts);
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
                let options = GatherOptions { gathers, seed, direct: false, ..OPTIONS };
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
    let camera = Camera::find(&[path], &scene, &overrides, &FileSystem).unwrap().camera;
    let options = GatherOptions { gathers: 4, method: Method::FinalGather, ..OPTIONS };
    let queries = |guide: Option<&[Photon]>| {
        let rays = GatherRays::new(&scene, camera, options);
        let rays = guide.into_iter().fold(rays, GatherRays::guided_by);
        let mut queries = vec![];
        PixelCaster::new(&rays, None).pixel(
            [12, 7],
            VisiblePoints::All,
            |query| queries.push(query),
            |_| {},
            &mut RayCounts::default(),
        );
        queries
    };
    assert_eq!(queries(None), queries(Some(&[])));
    let (some, _) = photons(&scene, 60_000);
    let guided = queries(Some(&some));
    assert_ne!(queries(None), guided);
    // The same names, in the same order.
    assert!(queries(None).iter().all(|query| query.pixel == guided[0].pixel));
}
