//! Light straight from the lamps that a point reflects, sampled at the lamps and, where a lobe is sharp, along the lobe.
//!
//! Veach and Guibas, *Optimally Combining Sampling Techniques for Monte Carlo Rendering*, SIGGRAPH 1995: a sharp lobe
//! before large lamps is seldom met by points on the lamps, and small lamps are seldom met along the lobe; weighed by the
//! balance heuristic, each technique counts where it is the likelier one.

use super::lights::Lights;
use super::reflection::Reflection;
use super::surface::{SurfacePoint, Surfaces};
use glam::Vec3;
use pm_random::Random;

/// Radiance that a point reflects of light straight from the lamps: the mean over `samples` shadow rays, and as many rays
/// along the lobe if there is one. A surface without a lobe draws no other random numbers than the shadow rays do.
pub(super) fn direct_light(
    surfaces: &Surfaces<'_>,
    lights: &Lights,
    point: &SurfacePoint,
    reflection: &Reflection,
    samples: u32,
    random: &mut Random,
) -> Vec3 {
    if !reflection.has_lobe() {
        return lights.reflected(surfaces, point, samples, random, |towards, _| reflection.brdf(towards));
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
