//! Lights: which triangle, and where on it.

use super::sampling::triangle_point;
use super::surface::{SurfacePoint, Surfaces};
use crate::scene::Scene;
use glam::Vec3;
use pm_random::Random;

/// The lights of a scene, to be chosen in proportion to their power.
pub(super) struct Lights {
    triangles: Vec<Light>,
}

struct Light {
    triangle: usize,
    radiance: Vec3,
    /// Flux in watts, per channel.
    flux: [f64; 3],
    area: f64,
    probability: f64,
    /// Sum of the probabilities up to and including this one.
    cumulative: f64,
}

/// A light chosen at random.
pub(super) struct Chosen<'a> {
    light: &'a Light,
}

/// Inverse plastic number and its square: the steps of the R2 sequence (Roberts, *The Unreasonable Effectiveness of
/// Quasirandom Sequences*, 2018).
const PLASTIC_STEPS: (f64, f64) = (0.754_877_666_246_692_8, 0.569_840_290_998_053_3);

impl Lights {
    pub(super) fn new(scene: &Scene) -> Self {
        let lights = scene.lights();
        let power = |flux: [f64; 3]| flux.iter().sum::<f64>();
        let total: f64 = lights.iter().map(|light| power(light.flux)).sum();
        let mut cumulative = 0.0;
        let triangles = lights
            .iter()
            .map(|light| {
                let probability = power(light.flux) / total;
                cumulative += probability;
                Light {
                    triangle: light.triangle as usize,
                    radiance: Vec3::from(light.emission),
                    flux: light.flux,
                    area: light.area,
                    probability,
                    cumulative,
                }
            })
            .collect();
        Self { triangles }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The number of the light at `u` in [0, 1) of the total power.
    pub(super) fn number_at(&self, u: f32) -> usize {
        let at = self.triangles.partition_point(|light| light.cumulative <= f64::from(u));
        // Rounding may leave the last sum below 1.
        at.min(self.triangles.len() - 1)
    }

    /// The light at `u` in [0, 1) of the total power.
    pub(super) fn choose(&self, u: f32) -> Chosen<'_> {
        self.numbered(self.number_at(u))
    }

    /// The light of a number.
    pub(super) fn numbered(&self, number: usize) -> Chosen<'_> {
        Chosen { light: &self.triangles[number] }
    }

    /// Each light's share of the total power.
    pub(super) fn shares(&self) -> impl Iterator<Item = f64> {
        self.triangles.iter().map(|light| light.probability)
    }

    /// Radiance that a point reflects of light that comes straight from the lights, the mean over `samples` shadow rays;
    /// `brdf` is its BRDF for a direction towards a light, perhaps weighed by the density with which that direction is
    /// chosen here, per steradian. With a BRDF of 1 this is the irradiance.
    ///
    /// Samples are strata of the total power; where they lie on the lights is a low-discrepancy sequence, shifted at
    /// random so that each sample by itself is spread evenly.
    pub(super) fn reflected(
        &self,
        surfaces: &Surfaces<'_>,
        point: &SurfacePoint,
        samples: u32,
        random: &mut Random,
        brdf: impl Fn(Vec3, f64) -> Vec3,
    ) -> Vec3 {
        if self.is_empty() || samples == 0 {
            return Vec3::ZERO;
        }
        let (shift_u, shift_v) = (random.unit(), random.unit());
        let mut sum = Vec3::ZERO;
        for sample in 0..samples {
            let chosen = self.choose((sample as f32 + random.unit()) / samples as f32);
            let along = |step: f64, shift: f32| (f64::from(sample) * step + f64::from(shift)).fract() as f32;
            let (u, v) = triangle_point(along(PLASTIC_STEPS.0, shift_u), along(PLASTIC_STEPS.1, shift_v));
            let (target, normal) = surfaces.point_before(chosen.light.triangle, u, v);
            let way = target - point.position;
            let cosine_here = way.dot(point.facing);
            let cosine_there = -way.dot(normal);
            if cosine_here <= 0.0 || cosine_there <= 0.0 || surfaces.blocked(point.start(way), target) {
                continue;
            }
            // cos cos' / d^2 over the density 1 / area; `way` is not normalised, hence d^4.
            let geometry = f64::from(cosine_here) * f64::from(cosine_there) / f64::from(way.length_squared()).powi(2);
            let weight = geometry * chosen.light.area / (chosen.light.probability * f64::from(samples));
            let density = chosen.light.density(way.length_squared(), cosine_there);
            sum += chosen.light.radiance * brdf(way.normalize(), density) * weight as f32;
        }
        sum
    }
}

impl Lights {
    /// The density, per steradian, with which a shadow ray from a point is sent to a point on a lamp; 0 if it is on none.
    pub(super) fn density(&self, from: Vec3, lamp: &SurfacePoint) -> f64 {
        let at = self.triangles.binary_search_by_key(&(lamp.triangle as usize), |light| light.triangle);
        let way = lamp.position - from;
        at.map_or(0.0, |at| self.triangles[at].density(way.length_squared(), -way.dot(lamp.front)))
    }
}

impl Light {
    /// The density, per steradian, with which its points are chosen, at a distance given squared and times the cosine of the
    /// angle to its normal.
    fn density(&self, distance_squared: f32, distance_cosine: f32) -> f64 {
        let d2 = f64::from(distance_squared);
        self.probability / self.area * d2 * d2.sqrt() / f64::from(distance_cosine)
    }
}

impl Chosen<'_> {
    /// A point on the light, lifted off its front, and the normal there.
    pub(super) fn point(&self, surfaces: &Surfaces<'_>, random: &mut Random) -> (Vec3, Vec3) {
        let (u, v) = triangle_point(random.unit(), random.unit());
        surfaces.point_before(self.light.triangle, u, v)
    }

    /// Flux of the light over the probability that [`Lights::choose`] chooses it, in watts.
    pub(super) fn path_flux(&self) -> Vec3 {
        self.flux_over(self.light.probability)
    }

    /// Flux of the light over the probability that it was chosen, in watts.
    pub(super) fn flux_over(&self, probability: f64) -> Vec3 {
        Vec3::from(self.light.flux.map(|flux| (flux / probability) as f32))
    }
}
