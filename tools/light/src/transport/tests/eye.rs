//! Are pixels seen where they are, and alike whenever they are come to?

use super::super::{GatherOptions, GatherRays, Method, PixelCaster, RayCounts};
use super::pictures::{OPTIONS, rays_with};
use super::scenes::{camera, shipped};
use crate::scene::{Camera, CameraOverrides, FileSystem};
use glam::Vec3;
use pm_orders::{Pass, VisiblePoints};

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
fn a_pixel_that_is_remembered_is_seen_as_at_first() {
    // The box with a mirror and a glass sphere, in passes that come to each pixel again, and from the second one on.
    let (scene, path) = shipped("cornell.obj");
    let overrides = CameraOverrides { size: Some([24, 20]), ..CameraOverrides::default() };
    let camera = Camera::find(&[path], &scene, &overrides, &FileSystem).unwrap().camera;
    let rays = GatherRays::new(&scene, camera, GatherOptions { gathers: 4, ..OPTIONS }).with_bins(4);
    let passes = Pass::every_ray(&[VisiblePoints::Direct, VisiblePoints::BehindSpecular], 4);
    for first in [0, 1] {
        let mut caster = PixelCaster::new(&rays, None);
        for &pass in &passes[first..] {
            let (mut remembered, mut afresh) =
                ((vec![], vec![], RayCounts::default()), (vec![], vec![], RayCounts::default()));
            for (x, y) in (0..20).flat_map(|y| (0..24).map(move |x| (x, y))) {
                let (queries, light, counts) = &mut remembered;
                caster.pixel([x, y], pass, |query| queries.push(query), |l| light.push(l), counts);
                let (queries, light, counts) = &mut afresh;
                PixelCaster::new(&rays, None).pixel(
                    [x, y],
                    pass,
                    |query| queries.push(query),
                    |l| light.push(l),
                    counts,
                );
            }
            assert_eq!(remembered, afresh, "{pass:?}");
            assert!(!afresh.0.is_empty() && (pass.bin > 0 || !afresh.1.is_empty()));
        }
    }
}
