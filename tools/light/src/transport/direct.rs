//! Light straight from the lamps that a point reflects, sampled at the lamps and, where a lobe is sharp, along the lobe;
//! at other points, by the gather rays that meet a lamp, which are cast anyway.
//!
//! Veach and Guibas, *Optimally Combining Sampling Techniques for Monte Carlo Rendering*, SIGGRAPH 1995: a sharp lobe
//! before large lamps is seldom met by points on the lamps, and small lamps are seldom met along the lobe; weighed by the
//! balance heuristic, each technique counts where it is the likelier one. So a lamp close by, whose nearest parts are seldom
//! sampled and then count for much, is left to the gather rays.

use super::lights::Lights;
use super::reflection::Reflection;
use super::surface::{SurfacePoint, Surfaces};
use glam::Vec3;
use pm_random::Random;
use std::f64::consts::PI;

/// How many rays look for the light of the lamps that a point reflects.
#[derive(Clone, Copy, Debug)]
pub(super) struct Techniques {
    /// Shadow rays.
    pub(super) shadow: u32,
    /// Gather rays, which count as spread by the cosine whatever they are: any shares that add up to 1 give the same light.
    pub(super) gather: u32,
}

impl Techniques {
    /// How much a shadow ray counts that is sent with this density per steradian, at this cosine to the normal.
    fn share_of_shadow_ray(self, cosine: f32, density: f64) -> f64 {
        let Self { shadow, gather } = self;
        let by_gather_rays = f64::from(gather) * f64::from(cosine) / PI;
        // A lamp seen from its edge has no end to its density.
        if by_gather_rays <= 0.0 || density.is_infinite() {
            return 1.0;
        }
        let by_shadow_rays = f64::from(shadow) * density;
        by_shadow_rays / (by_shadow_rays + by_gather_rays)
    }

    /// How much a gather ray counts that meets a lamp, at this cosine to the normal, to which shadow rays are sent with this
    /// density per steradian.
    pub(super) fn share_of_gather_ray(self, cosine: f32, density: f64) -> f32 {
        1.0 - self.share_of_shadow_ray(cosine, density) as f32
    }
}

/// Radiance that a point reflects of light straight from the lamps: the mean over the shadow rays, and as many rays along the
/// lobe if there is one; less what gather rays bring. A surface without a lobe draws no other random numbers than the shadow
/// rays do.
pub(super) fn direct_light(
    surfaces: &Surfaces<'_>,
    lights: &Lights,
    point: &SurfacePoint,
    reflection: &Reflection,
    techniques: Techniques,
    random: &mut Random,
) -> Vec3 {
    let samples = techniques.shadow;
    if !reflection.has_lobe() {
        return lights.reflected(surfaces, point, samples, random, |towards, density| {
            let share = techniques.share_of_shadow_ray(towards.dot(point.facing), density);
            reflection.brdf(towards) * share as f32
        });
    }
    let by_lamps = lights.reflected(surfaces, point, samples, random, |towards, density| {
        let share = density / (density + f64::from(reflection.lobe_density(towards)));
        reflection.brdf(towards) * share as f32
    });
    let mut by_lobe = Vec3::ZERO;
    for sample in 0..samples {
        let u = ((sample as f32 + random.unit()) / samples as f32).min(1.0);
        let v = random.unit();
        by_lobe += along_lobe(surfaces, lights, point, reflection, u, v) / samples as f32;
    }
    by_lamps + by_lobe
}

/// What one ray along the lobe brings, for `u` and `v` in [0, 1).
fn along_lobe(
    surfaces: &Surfaces<'_>,
    lights: &Lights,
    point: &SurfacePoint,
    reflection: &Reflection,
    u: f32,
    v: f32,
) -> Vec3 {
    let direction = reflection.lobe_direction(u, v);
    let cosine = direction.dot(point.facing);
    let density = reflection.lobe_density(direction);
    if cosine <= 0.0 || density <= 0.0 {
        return Vec3::ZERO;
    }
    let Some(lamp) = surfaces.hit(point.start(direction), direction) else { return Vec3::ZERO };
    let material = surfaces.material(&lamp);
    if !material.emits() || lamp.facing != lamp.front {
        return Vec3::ZERO;
    }
    let share = f64::from(density) / (f64::from(density) + lights.density(point.position, &lamp));
    Vec3::from(material.emission) * reflection.brdf(direction) * (cosine / density * share as f32)
}
