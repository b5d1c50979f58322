//! Queries: eye rays through the pixels, and from where they end a hemisphere of gather rays each.
//!
//! Steinhurst, Coombe, Lastra, *Reordering for Cache Conscious Photon Mapping*, GI 2005, Fig. 3 and Fig. 5.

use super::Purpose;
use super::lights::{Lights, direct_random};
use super::photon_paths::patience;
use super::sampling::{cosine_direction, grid};
use super::scatter::specular;
use super::surface::{Stage, SurfacePoint};
use crate::order::Leaves;
use crate::random::Random;
use crate::scene::{Camera, Scene};
use glam::Vec3;
use pm_formats::Query;

/// How queries are made.
#[derive(Clone, Copy, Debug)]
pub struct GatherOptions {
    /// Gather rays from each point seen.
    pub gathers: u32,
    /// Shadow rays from each point seen, for direct light.
    pub light_samples: u32,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Is direct light wanted at all? It changes no query.
    pub direct: bool,
    /// In which order the strata of a point are visited.
    pub strata: Strata,
}

/// In which order the strata of a hemisphere are visited; the rays are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Strata {
    /// Ring by ring: elevation outer, azimuth inner
    Raster,
    /// Another random order for each point
    Shuffled,
}

/// Rays that were cast.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Eye rays, with their reflections and refractions.
    pub eye: u64,
    /// Gather rays, not counting their reflections and refractions.
    pub gather: u64,
    /// Gather rays that left the scene or ended where there is nothing to ask for.
    pub gather_lost: u64,
}

impl std::ops::AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.eye += other.eye;
        self.gather += other.gather;
        self.gather_lost += other.gather_lost;
    }
}

/// Casts the rays of a picture.
pub struct GatherRays<'a> {
    stage: Stage<'a>,
    lights: Lights,
    camera: Camera,
    options: GatherOptions,
    strata: (u32, u32),
}

/// A point seen, with what share of its radiance the pixel gets.
struct Leaf {
    point: SurfacePoint,
    share: Vec3,
    behind_specular: bool,
}

/// Times that an eye ray is split at glass; after that one of its ways is chosen at random.
const SPLITS: u32 = 2;
/// Most points seen in one pixel sample.
const MAX_LEAVES: u32 = 1 << SPLITS;

impl<'a> GatherRays<'a> {
    /// Rays of a picture of `scene`.
    #[must_use]
    pub fn new(scene: &'a Scene, camera: Camera, options: GatherOptions) -> Self {
        let strata = grid(options.gathers.max(1));
        Self { stage: Stage::new(scene), lights: Lights::new(scene), camera, options, strata }
    }

    /// Most queries that a pixel can have.
    #[must_use]
    pub const fn most_queries_per_pixel(&self) -> u64 {
        self.options.gathers as u64 * MAX_LEAVES as u64
    }

    /// Casts the rays of one pixel: gives its queries to `query`, strata in raster order (elevation outer, azimuth inner),
    /// and light that needs no query (what is emitted or comes straight from the lights) to `light`.
    ///
    /// A query's sample number is `leaf * gathers + stratum`.
    pub fn pixel(
        &self,
        x: u32,
        y: u32,
        leaves: Leaves,
        mut query: impl FnMut(Query),
        mut light: impl FnMut(Vec3),
        counts: &mut RayCounts,
    ) {
        let pixel = y * self.camera.size()[0] + x;
        // Light seen by eye belongs to the pass that visits every pixel.
        let first_pass = leaves != Leaves::BehindSpecular;
        let mut found = vec![];
        let mut eye_light = |radiance: Vec3| {
            if first_pass {
                light(radiance);
            }
        };
        let mut ignored = RayCounts::default();
        self.see(x, y, pixel, &mut found, &mut eye_light, if first_pass { counts } else { &mut ignored });
        for (leaf, number) in found.iter().zip(0..) {
            let wanted = match leaves {
                Leaves::All => true,
                Leaves::Direct => !leaf.behind_specular,
                Leaves::BehindSpecular => leaf.behind_specular,
            };
            if wanted {
                self.gather(pixel, number, leaf, &mut query, &mut light, counts);
            }
        }
    }

    /// Follows the eye ray of a pixel to the points seen, through mirrors and glass.
    fn see(
        &self,
        x: u32,
        y: u32,
        pixel: u32,
        leaves: &mut Vec<Leaf>,
        light: &mut impl FnMut(Vec3),
        counts: &mut RayCounts,
    ) {
        let (eye, direction) = self.camera.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let random = &mut Random::new(&[self.options.seed, Purpose::EyePath as u64, u64::from(pixel)]);
        // Rays yet to be followed: origin, direction, share, splits left, specular hits so far.
        let mut rays = vec![(eye, direction, Vec3::ONE, SPLITS, 0u32)];
        while let Some((origin, direction, share, splits, hits)) = rays.pop() {
            counts.eye += 1;
            let Some(point) = self.stage.hit(origin, direction) else { continue };
            let material = self.stage.material(&point);
            if material.emits() && point.facing == point.front {
                light(share * Vec3::from(material.emission));
            }
            if Vec3::from(material.diffuse).max_element() > 0.0 {
                leaves.push(Leaf { point, share, behind_specular: hits > 0 });
            }
            let Some(patient) = patience(hits, random) else { continue };
            let ways = specular(material, &point, direction);
            let mut follow = |direction: Vec3, share: Vec3, splits: u32| {
                if share.max_element() > 0.0 {
                    rays.push((point.start(direction), direction, share * patient, splits, hits + 1));
                }
            };
            match ways {
                [Some(reflected), Some(refracted)] if splits > 0 => {
                    // Pushed last, followed first: what is seen through glass comes before what it reflects.
                    follow(reflected.direction, share * reflected.share, splits - 1);
                    follow(refracted.direction, share * refracted.share, splits - 1);
                }
                _ => {
                    if let Some((way, weight)) = choose(ways, random) {
                        follow(way.direction, share * way.share * weight, splits);
                    }
                }
            }
        }
    }

    /// Casts the gather rays of one point seen.
    fn gather(
        &self,
        pixel: u32,
        number: u32,
        leaf: &Leaf,
        query: &mut impl FnMut(Query),
        light: &mut impl FnMut(Vec3),
        counts: &mut RayCounts,
    ) {
        let GatherOptions { gathers, light_samples, seed, direct, .. } = self.options;
        let point = &leaf.point;
        let reflectance = Vec3::from(self.stage.material(point).diffuse);
        if direct {
            let random = &mut direct_random(seed, pixel, number);
            let irradiance = self.lights.irradiance(&self.stage, point, light_samples, random);
            light(leaf.share * reflectance * irradiance / std::f32::consts::PI);
        }
        // Cosine-distributed rays each carry reflectance / N of the radiance they meet.
        let share = leaf.share * reflectance / gathers as f32;
        let mut strata: Vec<u32> = (0..gathers).collect();
        if self.options.strata == Strata::Shuffled {
            let key = |stratum: &u32| {
                Random::new(&[seed, Purpose::StrataOrder as u64, pixel.into(), number.into(), (*stratum).into()])
                    .next_u64()
            };
            strata.sort_by_cached_key(key);
        }
        for stratum in strata {
            counts.gather += 1;
            let sample = number * gathers + stratum;
            let random = &mut Random::new(&[seed, Purpose::GatherRay as u64, u64::from(pixel), u64::from(sample)]);
            let (rows, columns) = self.strata;
            let u = ((stratum / columns) as f32 + random.unit()) / rows as f32;
            let v = ((stratum % columns) as f32 + random.unit()) / columns as f32;
            let direction = cosine_direction(point.facing, u.min(1.0), v);
            match self.follow(point.start(direction), direction, share, light, random) {
                Some((end, view, weight)) => {
                    let (normal, view) = Query::pack_vectors(end.facing.into(), view.into());
                    query(Query {
                        position: end.position.into(),
                        normal,
                        view,
                        material: end.material,
                        flags: 0,
                        pixel,
                        sample,
                        weight: weight.into(),
                    });
                }
                None => counts.gather_lost += 1,
            }
        }
    }

    /// Follows a gather ray through mirrors and glass to the diffuse surface where it ends: the point, the direction
    /// back, and what is left of the ray's weight.
    fn follow(
        &self,
        mut origin: Vec3,
        mut direction: Vec3,
        mut share: Vec3,
        light: &mut impl FnMut(Vec3),
        random: &mut Random,
    ) -> Option<(SurfacePoint, Vec3, Vec3)> {
        for hits in 0.. {
            let point = self.stage.hit(origin, direction)?;
            let material = self.stage.material(&point);
            // A light met directly is counted by the shadow rays; met in a mirror or through glass, only here.
            if hits > 0 && self.options.direct && material.emits() && point.facing == point.front {
                light(share * Vec3::from(material.emission));
            }
            let diffuse = Vec3::from(material.diffuse).max_element();
            let ways = specular(material, &point, direction);
            let specular_share: f32 = ways.iter().flatten().map(|way| way.share.max_element()).sum();
            // A surface that is both is one or the other for this ray.
            let total = diffuse + specular_share;
            if total <= 0.0 {
                return None;
            }
            if random.unit() * total < diffuse {
                return Some((point, -direction, share * (total / diffuse)));
            }
            let (way, weight) = choose(ways, random)?;
            let patient = patience(hits, random)?;
            share *= way.share * (weight * patient * (total / specular_share));
            origin = point.start(way.direction);
            direction = way.direction;
        }
        None
    }
}

/// Chooses one of the specular ways in proportion to its largest share; the weight makes up for the choice.
fn choose(ways: [Option<super::scatter::Specular>; 2], random: &mut Random) -> Option<(super::scatter::Specular, f32)> {
    match ways {
        [Some(first), Some(second)] => {
            let (a, b) = (first.share.max_element(), second.share.max_element());
            let total = a + b;
            if total <= 0.0 {
                return None;
            }
            Some(if random.unit() * total < a { (first, total / a) } else { (second, total / b) })
        }
        [way, other] => way.or(other).map(|way| (way, 1.0)),
    }
}
