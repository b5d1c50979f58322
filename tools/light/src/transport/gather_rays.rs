//! Queries: from the points that the eye sees a hemisphere of gather rays each, or the points themselves.
//!
//! Steinhurst, Coombe, Lastra, *Reordering for Cache Conscious Photon Mapping*, GI 2005, Fig. 3 and Fig. 5.

use super::Purpose;
use super::cache_records::CacheRecords;
use super::eye::{Eye, Leaf, choose};
use super::guide::Guide;
use super::lights::Lights;
use super::photon_paths::patience;
use super::reflection::{Reflection, Spread, spread_shares};
use super::sampling::{cosine_direction, grid};
use super::scatter::specular;
use super::surface::{Stage, SurfacePoint};
use crate::scene::{Camera, Scene};
use glam::Vec3;
use pm_formats::{Photon, Query};
use pm_orders::{Leaves, Pass};
use pm_random::Random;
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

/// How queries are made.
#[derive(Clone, Copy, Debug)]
pub struct GatherOptions {
    /// What is asked of the photon map.
    pub method: Method,
    /// Eye rays for each pixel: one goes through its middle, more are spread over it.
    pub samples: u32,
    /// Gather rays from each point seen.
    pub gathers: u32,
    /// How their directions are chosen.
    pub spread: Spread,
    /// Gather rays shorter than this, in scene units, are continued by one more bounce.
    pub min_gather_dist: f32,
    /// Shadow rays from each point seen, for direct light.
    pub light_samples: u32,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Is light wanted that needs no query? It changes no query.
    pub direct: bool,
    /// In which order the strata of a point are visited.
    pub strata: Strata,
    /// Does light count that comes to a point seen from a lamp through mirrors and glass? Not where a caustic map holds it.
    pub caustics: bool,
}

/// What is asked of the photon map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// What gather rays from the points seen meet: all light but that straight from the lamps.
    FinalGather,
    /// The points seen themselves: all light that they reflect, as the map's photons hold that from the lamps as well.
    DirectVisualisation,
}

pm_registry::choices! {
    /// In which order the strata of a hemisphere are visited; the rays are the same.
    #[derive(Debug)]
    pub enum Strata {
        /// Ring by ring: elevation outer, azimuth inner
        Raster = "raster",
        /// Another random order for each point
        Shuffled = "shuffled",
    }
}

/// Rays that were cast.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Eye rays, with their reflections and refractions.
    pub eye: u64,
    /// Eye rays that a later pass over their pixel asks for again, whether they were remembered or not.
    pub eye_again: u64,
    /// Points seen where light is spread.
    pub seen: u64,
    /// Gather rays, not counting their reflections and refractions.
    pub gather: u64,
    /// Gather rays that left the scene or ended where there is nothing to ask for.
    pub gather_lost: u64,
    /// Gather rays that were too short and were continued.
    pub gather_continued: u64,
    /// Points seen whose gather rays were guided by photons.
    pub guided: u64,
}

impl std::ops::AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.eye += other.eye;
        self.eye_again += other.eye_again;
        self.seen += other.seen;
        self.gather += other.gather;
        self.gather_lost += other.gather_lost;
        self.gather_continued += other.gather_continued;
        self.guided += other.guided;
    }
}

/// Casts the rays of a picture.
pub struct GatherRays<'a> {
    stage: Stage<'a>,
    lights: Lights,
    eye: Eye,
    options: GatherOptions,
    strata: (u32, u32),
    /// The strata of each bin of the hemisphere, in raster order.
    bins: Vec<Vec<u32>>,
    guide: Option<Guide>,
}

/// What of a pixel is cast at a visit: a pass, and of its rays those with these numbers.
struct Part<'r> {
    pass: Pass,
    rays: &'r mut Range<u64>,
}

/// Which of the next `n` rays lie in `rays`, whose numbers are then counted from behind these.
fn take(rays: &mut Range<u64>, n: usize) -> Range<usize> {
    let within = |at: u64| at.min(n as u64) as usize;
    let taken = within(rays.start)..within(rays.end);
    let less = |at: u64| at.saturating_sub(n as u64);
    *rays = less(rays.start)..less(rays.end);
    taken
}

/// Where a gather ray ends.
pub(super) struct End {
    pub(super) point: SurfacePoint,
    /// Unit vector back along the ray.
    pub(super) view: Vec3,
    /// What is left of the ray's weight.
    pub(super) weight: Vec3,
    /// Length of the ray, its reflections and refractions included.
    length: f32,
}

impl<'a> GatherRays<'a> {
    /// Rays of a picture of `scene`.
    #[must_use]
    pub fn new(scene: &'a Scene, camera: Camera, options: GatherOptions) -> Self {
        let strata = grid(options.gathers.max(1));
        let eye = Eye { camera, seed: options.seed, samples: options.samples.max(1) };
        let bins = vec![(0..options.gathers).collect()];
        Self { stage: Stage::new(scene), lights: Lights::new(scene), eye, options, strata, bins, guide: None }
    }

    /// Divides the hemisphere into bins, a grid in elevation and azimuth like the strata, for orders with a pass for each.
    /// A stratum belongs to the bin that holds its lower corner, so some bins are empty if there are more than strata.
    #[must_use]
    pub fn with_bins(mut self, bins: u32) -> Self {
        let (rows, columns) = self.strata;
        let (bin_rows, bin_columns) = grid(bins.max(1));
        self.bins = vec![vec![]; bins.max(1) as usize];
        for stratum in 0..self.options.gathers {
            let part = |at: u32, of: u32, bins: u32| u64::from(at) * u64::from(bins) / u64::from(of);
            let row = part(stratum / columns, rows, bin_rows);
            let column = part(stratum % columns, columns, bin_columns);
            self.bins[(row * u64::from(bin_columns) + column) as usize].push(stratum);
        }
        self
    }

    /// The same rays, but sent more often to where photons come from, and weighing less for it: for [`Spread::Cosine`].
    /// Where there are too few photons nothing changes; photons straight from a lamp do not count. Not for records of
    /// cached irradiance, whose gradients are made for even strata.
    #[must_use]
    pub fn guided_by(self, photons: &[Photon]) -> Self {
        let guide = Guide::new(&self.stage, photons);
        Self { guide: Some(guide), ..self }
    }

    /// Number of photons that guide the rays.
    #[must_use]
    pub fn guiding_photons(&self) -> usize {
        self.guide.as_ref().map_or(0, Guide::len)
    }

    /// Visits of pixels, which remember what is seen through those that they come to again.
    #[must_use]
    pub fn visits(&self) -> Visits<'_> {
        Visits { rays: self, seen: HashMap::new() }
    }

    /// Casts the eye rays of a pixel alone: the number of points seen directly, and of those behind specular surfaces.
    pub(super) fn points_seen(&self, [x, y]: [u32; 2], counts: &mut RayCounts) -> [u64; 2] {
        let mut found = vec![];
        counts.eye += self.eye.see(&self.stage, x, y, &mut found, &mut |_| {});
        counts.seen += found.len() as u64;
        let behind = found.iter().filter(|leaf| leaf.behind_specular).count();
        [found.len() - behind, behind].map(|points| points as u64)
    }

    /// Number of gather rays that a point seen sends into each bin.
    pub(super) fn rays_by_bin(&self) -> Vec<u64> {
        self.bins.iter().map(|strata| strata.len() as u64).collect()
    }

    /// Light that comes to a point seen straight from the lamps.
    fn direct_light(&self, pixel: u32, leaf: &Leaf, light: &mut impl FnMut(Vec3)) {
        let GatherOptions { light_samples, seed, direct, .. } = self.options;
        if direct {
            let reflection = Reflection::new(self.stage.material(&leaf.point), leaf.point.facing, leaf.view);
            let key = [seed, Purpose::DirectLight as u64, u64::from(pixel), u64::from(leaf.number)];
            let brdf = |towards: Vec3| reflection.brdf(towards);
            let random = &mut Random::new(&key);
            light(leaf.share * self.lights.reflected(&self.stage, &leaf.point, light_samples, random, brdf));
        }
    }

    /// The strata of a bin in the order in which they are cast from a point seen.
    fn strata_of(&self, pixel: u32, leaf: &Leaf, bin: u32) -> Cow<'_, [u32]> {
        let strata = &self.bins[bin as usize];
        if self.options.strata == Strata::Raster {
            return strata.into();
        }
        let key = |stratum: &u32| {
            let number = u64::from(leaf.number);
            let key = [self.options.seed, Purpose::StrataOrder as u64, pixel.into(), number, (*stratum).into()];
            Random::new(&key).next_u64()
        };
        let mut strata = strata.clone();
        strata.sort_by_cached_key(key);
        strata.into()
    }

    /// Casts the gather rays of one point seen that go through these strata.
    fn gather(
        &self,
        pixel: u32,
        leaf: &Leaf,
        strata: &[u32],
        query: &mut impl FnMut(Query),
        light: &mut impl FnMut(Vec3),
        counts: &mut RayCounts,
    ) {
        let GatherOptions { gathers, seed, spread, .. } = self.options;
        let (point, number) = (&leaf.point, leaf.number);
        let reflection = Reflection::new(self.stage.material(point), point.facing, leaf.view);
        let guide = self.guide.as_ref().and_then(|guide| guide.at(point.position, point.facing));
        // Each point has the first stratum once, whatever the order and the bins.
        counts.guided += u64::from(guide.is_some() && strata.contains(&0));
        for &stratum in strata {
            counts.gather += 1;
            let sample = number * gathers + stratum;
            let random = &mut Random::new(&[seed, Purpose::GatherRay as u64, u64::from(pixel), u64::from(sample)]);
            let (rows, columns) = self.strata;
            let u = ((stratum / columns) as f32 + random.unit()) / rows as f32;
            let v = ((stratum % columns) as f32 + random.unit()) / columns as f32;
            // Cosine-distributed rays each carry reflectance / N of the radiance they meet.
            let end =
                reflection.sample(spread, guide.as_ref(), u.min(1.0), v, random).and_then(|(direction, weight)| {
                    let share = leaf.share * weight / gathers as f32;
                    let key = [seed, Purpose::LightAtShortEnd as u64, u64::from(pixel), u64::from(sample)];
                    self.cast(point, direction, share, light, random, &mut Random::new(&key), counts)
                });
            match end {
                Some(end) => query(query_at(&end.point, end.view, pixel, sample, end.weight)),
                None => counts.gather_lost += 1,
            }
        }
    }

    /// Casts one gather ray from a point, and one bounce further if it is too short.
    #[expect(clippy::too_many_arguments, reason = "a ray, what it carries, two streams of random numbers, two outlets")]
    fn cast(
        &self,
        point: &SurfacePoint,
        direction: Vec3,
        share: Vec3,
        light: &mut impl FnMut(Vec3),
        random: &mut Random,
        for_light: &mut Random,
        counts: &mut RayCounts,
    ) -> Option<End> {
        let end = self.follow(point, direction, share, self.options.caustics, light, random)?;
        if end.length >= self.options.min_gather_dist {
            return Some(end);
        }
        counts.gather_continued += 1;
        self.continued(&end, light, random, for_light)
    }

    /// One bounce further: direct light at the end of a ray that was too short goes to `light`, and what comes there
    /// from elsewhere is asked for where one ray from there ends.
    ///
    /// Near a corner a ray may end within the photons' disc of where it began, and then what it finds is blotched like
    /// the map itself: Jensen, *Realistic Image Synthesis Using Photon Mapping*, 2001, section 8.5 (who traces on there).
    fn continued(
        &self,
        end: &End,
        light: &mut impl FnMut(Vec3),
        random: &mut Random,
        for_light: &mut Random,
    ) -> Option<End> {
        let reflection = Reflection::new(self.stage.material(&end.point), end.point.facing, end.view);
        if self.options.direct {
            let brdf = |towards: Vec3| reflection.brdf(towards);
            light(end.weight * self.lights.reflected(&self.stage, &end.point, 1, for_light, brdf));
        }
        let (u, v) = (random.unit(), random.unit());
        let (direction, weight) = reflection.sample(Spread::Cosine, None, u, v, random)?;
        self.follow(&end.point, direction, end.weight * weight, true, light, random)
    }

    /// Follows a gather ray through mirrors and glass to the surface where it ends, one that spreads light.
    /// Lamps met on the way count if `lamps` is true.
    fn follow(
        &self,
        start: &SurfacePoint,
        mut direction: Vec3,
        mut share: Vec3,
        lamps: bool,
        light: &mut impl FnMut(Vec3),
        random: &mut Random,
    ) -> Option<End> {
        let (mut from, mut length) = (*start, 0.0);
        for hits in 0.. {
            let point = self.stage.hit(from.start(direction), direction)?;
            length += point.position.distance(from.position);
            let material = self.stage.material(&point);
            // A light met directly is counted by the shadow rays; met in a mirror or through glass, only here.
            if hits > 0 && lamps && self.options.direct && material.emits() && point.facing == point.front {
                light(share * Vec3::from(material.emission));
            }
            let (diffuse, lobe) = spread_shares(material);
            let spread = diffuse.max_element() + lobe.max_element();
            let ways = specular(material, &point, direction);
            let specular_share: f32 = ways.iter().flatten().map(|way| way.share.max_element()).sum();
            // A surface that is both is one or the other for this ray.
            let total = spread + specular_share;
            if total <= 0.0 {
                return None;
            }
            if random.unit() * total < spread {
                return Some(End { point, view: -direction, weight: share * (total / spread), length });
            }
            let (way, weight) = choose(ways, random)?;
            let patient = patience(hits, random)?;
            share *= way.share * (weight * patient * (total / specular_share));
            from = point;
            direction = way.direction;
        }
        None
    }
}

/// Visits of pixels, pass after pass. What is seen through a pixel is remembered, since an order with a pass for each bin of
/// the hemisphere comes to it a hundred times; the memory grows with the pixels visited.
pub struct Visits<'a> {
    rays: &'a GatherRays<'a>,
    /// By pixel: the points seen, and the eye rays that found them.
    seen: HashMap<u32, (Vec<Leaf>, u64)>,
}

impl Visits<'_> {
    /// Casts the rays of one pixel: gives its queries to `query`, strata in raster order (elevation outer, azimuth inner),
    /// and light that needs no query (what is emitted or, with final gather, comes straight from the lights) to `light`.
    ///
    /// A query's sample number is `(leaf * samples + sample) * gathers + stratum`.
    ///
    /// With cached irradiance the points that it serves are not gathered for; the records that were placed at this pixel
    /// are.
    ///
    /// `pass` tells which of the rays are wanted now; light that needs no gather ray comes with a pixel's first bin.
    pub fn pixel(
        &mut self,
        at: [u32; 2],
        pass: impl Into<Pass>,
        cache: Option<&CacheRecords>,
        query: impl FnMut(Query),
        light: impl FnMut(Vec3),
        counts: &mut RayCounts,
    ) {
        let mut all = 0..u64::MAX;
        self.visit(at, Part { pass: pass.into(), rays: &mut all }, cache, query, light, counts);
    }

    /// Casts some of the gather rays of one pixel and pass: those with numbers in `rays`, counted from the first that
    /// [`pixel`](Self::pixel) would cast. Then takes their number off both ends of `rays`, which so goes on at the pixel
    /// that comes next. No light is asked for.
    ///
    /// The eye rays are counted as cast again: it takes all of them to know the numbers.
    pub fn some_of_pixel(
        &mut self,
        at: [u32; 2],
        pass: Pass,
        rays: &mut Range<u64>,
        query: impl FnMut(Query),
        counts: &mut RayCounts,
    ) {
        let mut now = RayCounts::default();
        self.visit(at, Part { pass, rays }, None, query, |_| {}, &mut now);
        *counts += RayCounts { eye: 0, eye_again: now.eye + now.eye_again, seen: 0, ..now };
    }

    fn visit(
        &mut self,
        [x, y]: [u32; 2],
        part: Part<'_>,
        cache: Option<&CacheRecords>,
        mut query: impl FnMut(Query),
        mut light: impl FnMut(Vec3),
        counts: &mut RayCounts,
    ) {
        let rays_of = self.rays;
        let pixel = y * rays_of.eye.camera.size()[0] + x;
        let Part { pass, rays } = part;
        let Pass { leaves, bin } = pass;
        // Light seen by eye belongs to the first of the passes that visit every pixel.
        let first_pass = pass.is_first();
        let mut eye_light = |radiance: Vec3| {
            if first_pass {
                light(radiance);
            }
        };
        if first_pass {
            // Light is to be told even if a pixel should be begun twice.
            self.seen.remove(&pixel);
        }
        let (found, eye_rays) = self.seen.entry(pixel).or_insert_with(|| {
            let mut found = vec![];
            let eye_rays = rays_of.eye.see(&rays_of.stage, x, y, &mut found, &mut eye_light);
            (found, eye_rays)
        });
        *(if first_pass { &mut counts.eye } else { &mut counts.eye_again }) += *eye_rays;
        let wanted = |behind_specular: bool| match leaves {
            Leaves::All => true,
            Leaves::Direct => !behind_specular,
            Leaves::BehindSpecular => behind_specular,
        };
        for leaf in &*found {
            if wanted(leaf.behind_specular) {
                counts.seen += u64::from(bin == 0);
                match rays_of.options.method {
                    Method::FinalGather if cache.is_some() && rays_of.caches(leaf) => {
                        if bin == 0 {
                            rays_of.direct_light(pixel, leaf, &mut light);
                        }
                    }
                    Method::FinalGather => {
                        if bin == 0 {
                            rays_of.direct_light(pixel, leaf, &mut light);
                        }
                        let wanted = take(rays, rays_of.bins[bin as usize].len());
                        if !wanted.is_empty() {
                            let strata = rays_of.strata_of(pixel, leaf, bin);
                            rays_of.gather(pixel, leaf, &strata[wanted], &mut query, &mut light, counts);
                        }
                    }
                    Method::DirectVisualisation => {
                        if bin == 0 && !take(rays, 1).is_empty() {
                            query(query_at(&leaf.point, leaf.view, pixel, leaf.number, leaf.share));
                        }
                    }
                }
            }
        }
        if let Some(cache) = cache {
            for (record, _) in cache.of_pixel(pixel).filter(|&(_, behind_specular)| wanted(behind_specular)) {
                cache.gather(rays_of, record, &rays_of.bins[bin as usize], &mut query, counts);
            }
        }
    }
}

/// What irradiance caching needs of the rays.
impl GatherRays<'_> {
    /// Width and height of the picture in pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        self.eye.camera.size()
    }

    /// Angle between the middles of neighbouring pixels, in radians.
    pub(super) fn pixel_angle(&self) -> f32 {
        let camera = &self.eye.camera;
        (2.0 * libm::tan(camera.vfov().to_radians() / 2.0) / f64::from(camera.size()[1])) as f32
    }

    /// Gather rays from each record.
    pub(super) const fn gathers(&self) -> u32 {
        self.options.gathers
    }

    /// Strata of elevation and of azimuth.
    pub(super) const fn strata(&self) -> (u32, u32) {
        self.strata
    }

    /// The points seen in a pixel.
    pub(super) fn leaves(&self, x: u32, y: u32) -> Vec<Leaf> {
        let mut leaves = vec![];
        self.eye.see(&self.stage, x, y, &mut leaves, &mut |_| {});
        leaves
    }

    /// Can a point's reflected light be told from its irradiance alone? Not where it has a glossy lobe.
    pub(super) fn caches(&self, leaf: &Leaf) -> bool {
        let (diffuse, lobe) = spread_shares(self.stage.material(&leaf.point));
        diffuse.max_element() > 0.0 && lobe.max_element() <= 0.0
    }

    /// Diffuse reflectance of a point.
    pub(super) fn reflectance(&self, leaf: &Leaf) -> Vec3 {
        spread_shares(self.stage.material(&leaf.point)).0
    }

    /// Length of a record's ray to the first surface; infinite if it meets none.
    pub(super) fn length(&self, point: &SurfacePoint, record: u32, sample: u32) -> f32 {
        let (direction, _) = self.record_direction(point, record, sample);
        let hit = self.stage.hit(point.start(direction), direction);
        hit.map_or(f32::INFINITY, |hit| hit.position.distance(point.position))
    }

    /// Casts a record's ray; its weight is 1, changed only by what it meets on the way.
    pub(super) fn record_ray(
        &self,
        point: &SurfacePoint,
        record: u32,
        sample: u32,
        light: &mut impl FnMut(Vec3),
        counts: &mut RayCounts,
    ) -> Option<End> {
        let (direction, mut random) = self.record_direction(point, record, sample);
        let key = [self.options.seed, Purpose::LightAtShortEnd as u64, RECORDS | u64::from(record), sample.into()];
        self.cast(point, direction, Vec3::ONE, light, &mut random, &mut Random::new(&key), counts)
    }

    /// The direction of a record's ray within its stratum, and the random numbers for what follows.
    fn record_direction(&self, point: &SurfacePoint, record: u32, sample: u32) -> (Vec3, Random) {
        let key = [self.options.seed, Purpose::RecordRay as u64, record.into(), sample.into()];
        let mut random = Random::new(&key);
        let (rows, columns) = self.strata;
        let u = ((sample / columns) as f32 + random.unit()) / rows as f32;
        let v = ((sample % columns) as f32 + random.unit()) / columns as f32;
        (cosine_direction(point.facing, u.min(1.0), v), random)
    }
}

/// Sets the keys of records apart from those of pixels.
const RECORDS: u64 = 1 << 32;

/// A query for the radiance that a point sends along `view`.
pub(super) fn query_at(point: &SurfacePoint, view: Vec3, pixel: u32, sample: u32, weight: Vec3) -> Query {
    let (normal, view) = Query::pack_vectors(point.facing.into(), view.into());
    Query {
        position: point.position.into(),
        normal,
        view,
        material: point.material,
        flags: 0,
        pixel,
        sample,
        weight: weight.into(),
    }
}
