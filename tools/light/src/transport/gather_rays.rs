//! Gather rays: from each of the points that the eye sees, one through each stratum of its hemisphere.
//!
//! Steinhurst, Coombe, Lastra, *Reordering for Cache Conscious Photon Mapping*, GI 2005, Fig. 3 and Fig. 5.

use super::bvh::{Ray, RayHit};
use super::direct::{Techniques, direct_light};
use super::eye::{Eye, VisiblePoint};
use super::gather_options::GatherOptions;
use super::gather_path::{GatherPaths, PathRandom};
use super::guide::{FEWEST, Guide};
use super::purpose::Purpose;
use super::query::query_at;
use super::ray_counts::RayCounts;
use super::reflection::Reflection;
use super::strata::{Strata, StrataGrid};
use super::surface::{SurfacePoint, Surfaces};
use crate::scene::{Camera, Material};
use glam::Vec3;
use pm_formats::{Photon, Query};
use pm_random::Random;
use std::borrow::Cow;

/// Gather rays of one point: all are chosen, then all are cast, and then it is seen where they end, so that none has to wait
/// for what another finds. Room that is used again.
#[derive(Default)]
pub(super) struct Batch {
    /// Where in the unit square rays are that all weigh the same, and where they go to.
    numbers: Vec<(f32, f32)>,
    directions: Vec<Vec3>,
    rays: Vec<Ray>,
    started: Vec<Started>,
    hits: Vec<Option<RayHit>>,
}

/// What is known of a gather ray before it is cast.
struct Started {
    sample: u32,
    weight: Vec3,
    random: Random,
}

impl Batch {
    fn clear(&mut self) {
        self.numbers.clear();
        self.rays.clear();
        self.started.clear();
    }

    fn add(&mut self, from: &SurfacePoint, direction: Vec3, started: Started) {
        self.rays.push(ray(from, direction));
        self.started.push(started);
    }

    /// Adds the rays of `numbers`, of which all else is there.
    fn add_even(&mut self, from: &SurfacePoint, reflection: &Reflection) {
        reflection.cosine_directions(&self.numbers, &mut self.directions);
        self.rays.extend(self.directions.iter().map(|&direction| ray(from, direction)));
    }
}

fn ray(from: &SurfacePoint, direction: Vec3) -> Ray {
    Ray { origin: from.start(direction), direction, far: f32::INFINITY }
}

/// Casts the rays of a picture.
pub struct GatherRays<'a> {
    pub(super) paths: GatherPaths<'a>,
    pub(super) options: GatherOptions,
    pub(super) strata: StrataGrid,
    eye: Eye,
    guide: Option<Guide>,
}

impl<'a> GatherRays<'a> {
    /// Rays of a picture of a scene, which may have been made ready for rays before.
    #[must_use]
    pub fn new(scene: impl Into<Surfaces<'a>>, camera: Camera, options: GatherOptions) -> Self {
        let eye = Eye { camera, seed: options.seed, samples: options.samples.max(1) };
        let paths = GatherPaths::new(scene.into(), options);
        Self { paths, options, strata: StrataGrid::new(options.gathers), eye, guide: None }
    }

    /// Divides the hemisphere into bins, a grid in elevation and azimuth like the strata, for orders with a pass for each.
    /// A stratum belongs to the bin that holds its lower corner, so some bins are empty if there are more than strata.
    #[must_use]
    pub fn with_bins(self, bins: u32) -> Self {
        Self { strata: self.strata.with_bins(bins), ..self }
    }

    /// The same rays, but sent more often to where photons come from, and weighing less for it: for
    /// [`Spread::Cosine`](super::Spread::Cosine). Where there are too few photons nothing changes; photons straight from a
    /// lamp do not count. Not for records of cached irradiance, whose gradients are made for even strata.
    #[must_use]
    pub fn guided_by(self, photons: &[Photon]) -> Self {
        let guide = Guide::new(&self.paths.surfaces, photons);
        Self { guide: Some(guide), ..self }
    }

    /// Number of photons that guide the rays.
    #[must_use]
    pub fn guiding_photons(&self) -> usize {
        self.guide.as_ref().map_or(0, Guide::len)
    }

    /// Fewest photons that have to be about a point to guide its rays.
    pub const FEWEST_GUIDES: usize = FEWEST;

    /// Is there any place where photons guide the rays?
    #[must_use]
    pub fn are_guided(&self) -> bool {
        self.guide.as_ref().is_some_and(Guide::guides_somewhere)
    }

    /// The camera through which the picture is seen.
    pub(super) const fn camera(&self) -> &Camera {
        &self.eye.camera
    }

    /// Width and height of the picture in pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        self.camera().size()
    }

    /// What a point's surface is made of.
    pub(super) fn material(&self, visible: &VisiblePoint) -> &Material {
        self.paths.surfaces.material(&visible.point)
    }

    /// Adds the points seen in a pixel, in order, and returns the number of eye rays that found them; what is emitted on the
    /// way goes to `light`.
    pub(super) fn see(&self, [x, y]: [u32; 2], points: &mut Vec<VisiblePoint>, light: &mut impl FnMut(Vec3)) -> u64 {
        self.eye.see(&self.paths.surfaces, x, y, points, light)
    }

    /// Which rays look for the lamps at a point of this reflection, from which gather rays are cast.
    fn techniques(&self, reflection: &Reflection) -> Techniques {
        let GatherOptions { light_samples, gathers, .. } = self.options;
        Techniques { shadow: light_samples, gather: if reflection.has_lobe() { 0 } else { gathers } }
    }

    /// Light that comes to a point seen straight from the lamps: all of it, or what its gather rays leave over.
    pub(super) fn direct_light(&self, pixel: u32, visible: &VisiblePoint, gathered: bool, light: &mut dyn FnMut(Vec3)) {
        let GatherOptions { seed, direct, .. } = self.options;
        if direct {
            let reflection = Reflection::new(self.material(visible), visible.point.facing, visible.view);
            let key = [seed, Purpose::DirectLight as u64, u64::from(pixel), u64::from(visible.number)];
            let random = &mut Random::new(&key);
            let GatherPaths { lights, surfaces, .. } = &self.paths;
            let mut techniques = self.techniques(&reflection);
            techniques.gather *= u32::from(gathered);
            light(visible.share * direct_light(surfaces, lights, &visible.point, &reflection, techniques, random));
        }
    }

    /// The strata of a bin in the order in which they are cast from a point seen.
    pub(super) fn strata_of(&self, pixel: u32, visible: &VisiblePoint, bin: u32) -> Cow<'_, [u32]> {
        let strata = self.strata.of_bin(bin);
        if self.options.strata == Strata::Raster {
            return strata.into();
        }
        let key = |stratum: &u32| {
            let number = u64::from(visible.number);
            let key = [self.options.seed, Purpose::StrataOrder as u64, pixel.into(), number, (*stratum).into()];
            Random::new(&key).next_u64()
        };
        let mut strata = strata.to_vec();
        strata.sort_by_cached_key(key);
        strata.into()
    }

    /// Casts the gather rays of one point seen that go through these strata, and tells of each query whether its ray went by a
    /// mirror or through glass.
    pub(super) fn gather(
        &self,
        pixel: u32,
        visible: &VisiblePoint,
        strata: &[u32],
        query: &mut impl FnMut(Query, bool),
        light: &mut dyn FnMut(Vec3),
        (batch, counts): (&mut Batch, &mut RayCounts),
    ) {
        let GatherOptions { gathers, seed, spread, .. } = self.options;
        let (point, number) = (&visible.point, visible.number);
        let reflection = Reflection::new(self.material(visible), point.facing, visible.view);
        let techniques = self.techniques(&reflection);
        let guide = self.guide.as_ref().and_then(|guide| guide.at(point.position, point.facing));
        // Each point has the first stratum once, whatever the order and the bins.
        counts.guided += u64::from(guide.is_some() && strata.contains(&0));
        let [of_path, of_light] = [Purpose::GatherRay, Purpose::LightAtShortEnd]
            .map(|purpose| Random::new(&[seed, purpose as u64, pixel.into()]));
        // Where all rays weigh the same.
        let even = reflection.even(spread, guide.as_ref()).map(|weight| visible.share * weight / gathers as f32);
        batch.clear();
        for &stratum in strata {
            let sample = number * gathers + stratum;
            let mut random = of_path.with(sample.into());
            let (u, v) = self.strata.point(stratum, &mut random);
            // Cosine-distributed rays each carry reflectance / N of the radiance they meet.
            if let Some(weight) = even {
                batch.numbers.push((u, v));
                batch.started.push(Started { sample, weight, random });
            } else if let Some((direction, weight)) = reflection.sample(spread, guide.as_ref(), u, v, &mut random) {
                let weight = visible.share * weight / gathers as f32;
                batch.add(point, direction, Started { sample, weight, random });
            }
        }
        batch.add_even(point, &reflection);
        counts.gather += strata.len() as u64;
        counts.gather_lost += (strata.len() - batch.rays.len()) as u64;
        self.paths.surfaces.hit_each(&batch.rays, &mut batch.hits);
        for ((ray, started), hit) in batch.rays.iter().zip(&batch.started).zip(&batch.hits) {
            let (sample, direction) = (started.sample, ray.direction);
            if let Some(met) = hit.as_ref().map(|hit| self.paths.surfaces.met(hit, direction))
                && self.paths.ends_at(point, &met)
            {
                query(met.query(-direction, pixel, sample, started.weight), false);
                continue;
            }
            let mut random =
                PathRandom { path: started.random.clone(), light_at_short_end: || of_light.with(sample.into()) };
            let end = hit.and_then(|hit| {
                let first = self.paths.surfaces.point(hit, direction);
                let how = (direction, techniques);
                self.paths.cast_to(point, how, first, started.weight, &mut random, light, counts)
            });
            match end {
                Some(end) => query(query_at(&end.point, end.view, pixel, sample, end.weight), end.behind_specular),
                None => counts.gather_lost += 1,
            }
        }
    }
}
