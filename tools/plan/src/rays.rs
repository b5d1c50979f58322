//! Rays through pixels: light that needs no photon map, and the queries.

use crate::replicates::Values;
use pm_formats::Query;
use pm_light::scene::Camera;
use pm_light::transport::{
    AtSpecular, GatherOptions, GatherRays, Method, PixelCaster, RayCounts, Spread, Strata, Surfaces,
};
use pm_orders::VisiblePoints;

/// What the rays of some pixels found.
pub(crate) struct RaySet {
    /// Light that needs no query, by pixel.
    pub(crate) light: Values,
    /// Queries of all pixels, those of one together.
    pub(crate) queries: Vec<Query>,
    /// Where the queries of each pixel end.
    pub(crate) ends: Vec<usize>,
}

/// How rays are cast: eye rays of a pixel, gather rays and shadow rays of a point seen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Design {
    pub(crate) samples: u32,
    pub(crate) gathers: u32,
    pub(crate) light_samples: u32,
}

impl Design {
    /// Gather rays and direct light. Caustics are left to a map of theirs, if there is one.
    pub(crate) fn soft(self, seed: u64, caustics_apart: bool) -> GatherOptions {
        GatherOptions {
            method: Method::FinalGather,
            samples: self.samples,
            gathers: self.gathers,
            spread: Spread::Cosine,
            min_gather_dist: 0.0,
            light_samples: self.light_samples,
            seed,
            direct: true,
            strata: Strata::Raster,
            at_specular: AtSpecular::GoOn,
            queue_specular: false,
            caustics: !caustics_apart,
        }
    }

    /// The points seen themselves, where caustics are asked for.
    pub(crate) fn seen(samples: u32, seed: u64) -> GatherOptions {
        let design = Self { samples, gathers: 1, light_samples: 1 };
        GatherOptions { method: Method::DirectVisualisation, direct: false, ..design.soft(seed, false) }
    }
}

/// Casts the rays of some pixels.
pub(crate) fn cast(surfaces: &Surfaces<'_>, camera: Camera, pixels: &[[u32; 2]], options: GatherOptions) -> RaySet {
    let rays = GatherRays::new(surfaces.clone(), camera, options);
    let mut set = RaySet { light: vec![], queries: vec![], ends: vec![] };
    // Light seen by eye is told with direct light, and a picture of the points seen has it already.
    let lit = options.direct;
    for &pixel in pixels {
        let mut caster = PixelCaster::new(&rays, None);
        let mut light = [0.0; 3];
        let add = |radiance: glam::Vec3| {
            if lit {
                (0..3).for_each(|c| light[c] += f64::from(radiance[c]));
            }
        };
        let counts = &mut RayCounts::default();
        caster.pixel(pixel, VisiblePoints::All, |query| set.queries.push(query), add, counts);
        set.light.push(light);
        set.ends.push(set.queries.len());
    }
    set
}
