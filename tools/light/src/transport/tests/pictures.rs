//! The queries and the light of a small picture.

use super::super::{AtSpecular, GatherOptions, GatherRays, Method, PixelCaster, RayCounts, Spread, Strata};
use crate::scene::{Camera, CameraOverrides, FileSystem, Scene};
use glam::Vec3;
use pm_orders::VisiblePoints;
use std::path::Path;

pub(in crate::transport) fn rays(
    scene: &Scene,
    path: &Path,
    gathers: u32,
    strata: Strata,
) -> (Vec<pm_formats::Query>, Vec<Vec3>, Camera) {
    let overrides = CameraOverrides { size: Some([24, 20]), ..CameraOverrides::default() };
    let camera = Camera::find(&[path.to_owned()], scene, &overrides, &FileSystem).unwrap().camera;
    rays_with(scene, camera, GatherOptions { gathers, strata, ..OPTIONS })
}

pub(in crate::transport) const OPTIONS: GatherOptions = GatherOptions {
    method: Method::FinalGather,
    samples: 1,
    gathers: 1,
    spread: Spread::Cosine,
    min_gather_dist: 0.0,
    light_samples: 4,
    seed: 9,
    direct: true,
    strata: Strata::Raster,
    at_specular: AtSpecular::GoOn,
    queue_specular: false,
    caustics: true,
};

pub(in crate::transport) fn rays_with(
    scene: &Scene,
    camera: Camera,
    options: GatherOptions,
) -> (Vec<pm_formats::Query>, Vec<Vec3>, Camera) {
    let rays = GatherRays::new(scene, camera, options);
    let (mut queries, mut light) = (vec![], vec![Vec3::ZERO; 24 * 20]);
    let mut counts = RayCounts::default();
    for y in 0..20 {
        for x in 0..24 {
            let pixel = (y * 24 + x) as usize;
            PixelCaster::new(&rays, None).pixel(
                [x, y],
                VisiblePoints::All,
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

/// Sum over all pixels of the queries' weights.
pub(in crate::transport) fn total(queries: &[pm_formats::Query]) -> glam::DVec3 {
    queries.iter().map(|query| Vec3::from(query.weight).as_dvec3()).sum()
}
