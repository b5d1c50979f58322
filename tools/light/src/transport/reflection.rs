//! How a surface spreads light over many directions: Lambert, and Phong's lobe where it is glossy.

use super::directions::Directions;
use super::sampling::{cosine_direction_in, cosine_directions_in, phong_direction, uniform_direction};
use super::scatter::spread_shares;
use crate::scene::Material;
use glam::Vec3;
use pm_film::hemisphere::frame;
use pm_random::Random;
use std::f32::consts::PI;

pm_registry::choices! {
    /// How directions are chosen for light that a diffuse surface spreads.
    #[derive(Debug)]
    pub enum Spread {
        /// In proportion to the cosine: every ray counts the same
        Cosine = "cosine",
        /// Evenly over the hemisphere: rays count by their cosine
        Uniform = "uniform",
    }
}

/// The reflection of light at a point between one direction, which is known, and any other.
///
/// The lobe is Phong's about the mirrored direction, `specular (n + 2) / (2 pi) cos^n` over the larger of the cosines of
/// the two directions: Neumann, Neumann, Szirmay-Kalos, *Compact Metallic Reflectance Models*, Eurographics 1999. It is
/// reciprocal; it reflects `specular` of what comes along the normal, never more, and the sharper it is the less is
/// lost at grazing angles (without the cosine, as in Lafortune and Willems 1994, a third is lost of diffuse light).
#[derive(Clone, Copy, Debug)]
pub(super) struct Reflection {
    diffuse: Vec3,
    specular: Vec3,
    exponent: f32,
    normal: Vec3,
    /// Two directions along the surface.
    frame: (Vec3, Vec3),
    /// The known direction, mirrored: as steep as itself.
    axis: Vec3,
}

/// Directions along the surface must not divide by zero.
const LEAST_COSINE: f32 = 1e-4;

impl Reflection {
    /// At a surface with this normal, on the side of `known`: a unit vector away from the surface.
    pub(super) fn new(material: &Material, normal: Vec3, known: Vec3) -> Self {
        let (diffuse, specular) = spread_shares(material);
        let axis = normal * (2.0 * normal.dot(known)) - known;
        Self { diffuse, specular, exponent: material.exponent, normal, frame: frame(normal), axis }
    }

    /// The BRDF for a unit vector away from the surface, per steradian.
    pub(super) fn brdf(&self, other: Vec3) -> Vec3 {
        let lambert = self.diffuse / PI;
        if !self.has_lobe() {
            return lambert;
        }
        lambert + self.specular * ((self.exponent + 2.0) / (2.0 * PI) * self.lobe(other) / self.larger_cosine(other))
    }

    /// Is there a lobe?
    pub(super) fn has_lobe(&self) -> bool {
        self.specular != Vec3::ZERO
    }

    /// A direction of the lobe for `u` and `v` in [0, 1); it may lie below the surface.
    pub(super) fn lobe_direction(&self, u: f32, v: f32) -> Vec3 {
        phong_direction(self.axis, self.exponent, u, v)
    }

    /// The density, per steradian, with which [`lobe_direction`](Self::lobe_direction) chooses a direction.
    pub(super) fn lobe_density(&self, direction: Vec3) -> f32 {
        (self.exponent + 1.0) / (2.0 * PI) * self.lobe(direction)
    }

    /// What every direction carries that [`sample`](Self::sample) chooses, where it is the same for all: those are
    /// [by the cosine](Self::cosine_direction) then, and no other random number is taken.
    pub(super) fn even(&self, spread: Spread, guide: Option<&Directions>) -> Option<Vec3> {
        let even = self.specular.max_element() <= 0.0 && spread == Spread::Cosine && guide.is_none();
        even.then_some(self.diffuse)
    }

    /// A direction in proportion to the cosine, for `u` and `v` in [0, 1).
    #[inline]
    pub(super) fn cosine_direction(&self, u: f32, v: f32) -> Vec3 {
        cosine_direction_in(self.frame, self.normal, u, v)
    }

    /// The same of many pairs of numbers, into `directions`.
    pub(super) fn cosine_directions(&self, numbers: &[(f32, f32)], directions: &mut Vec<Vec3>) {
        directions.clear();
        cosine_directions_in(self.frame, self.normal, numbers, directions);
    }

    fn larger_cosine(&self, other: Vec3) -> f32 {
        self.normal.dot(self.axis).max(self.normal.dot(other)).max(LEAST_COSINE)
    }

    fn lobe(&self, other: Vec3) -> f32 {
        libm::powf(self.axis.dot(other).clamp(0.0, 1.0), self.exponent)
    }

    /// A direction for `u` and `v` in [0, 1), with the BRDF times the cosine over the density it was chosen with; `None`
    /// if it would lie below the surface.
    ///
    /// At a glossy surface one of the two parts is chosen at random in proportion to its share, but the density is that
    /// of both together: the balance heuristic of Veach and Guibas, *Optimally Combining Sampling Techniques for Monte
    /// Carlo Rendering*, SIGGRAPH 1995. A guide takes the place of the cosine.
    pub(super) fn sample(
        &self,
        spread: Spread,
        guide: Option<&Directions>,
        u: f32,
        v: f32,
        random: &mut Random,
    ) -> Option<(Vec3, Vec3)> {
        if let Some(weight) = self.even(spread, guide) {
            return Some((self.cosine_direction(u, v), weight));
        }
        let (diffuse, specular) = (self.diffuse.max_element(), self.specular.max_element());
        if let (Some(guide), true) = (guide, specular <= 0.0 && spread == Spread::Cosine) {
            let (direction, density) = guide.sample(u, v);
            return Some((direction, self.diffuse / density));
        }
        let total = diffuse + specular;
        let direction = if specular > 0.0 && random.unit() * total >= diffuse {
            self.lobe_direction(u, v)
        } else if spread == Spread::Uniform {
            uniform_direction(self.normal, u, v)
        } else {
            guide.map_or_else(|| self.cosine_direction(u, v), |guide| guide.sample(u, v).0)
        };
        let cosine = direction.dot(self.normal);
        if cosine <= 0.0 {
            return None;
        }
        let broad = match (spread, guide) {
            (Spread::Uniform, _) => 1.0 / (2.0 * PI),
            (Spread::Cosine, None) => cosine / PI,
            (Spread::Cosine, Some(guide)) => guide.density(direction) * cosine / PI,
        };
        let narrow = if specular > 0.0 { self.lobe_density(direction) } else { 0.0 };
        let density = (diffuse * broad + specular * narrow) / total;
        Some((direction, self.brdf(direction) * (cosine / density)))
    }

    /// A direction of the lobe alone, with what it carries; `None` if it would lie below the surface.
    pub(super) fn sample_lobe(&self, u: f32, v: f32) -> Option<(Vec3, Vec3)> {
        let direction = self.lobe_direction(u, v);
        let cosine = direction.dot(self.normal);
        // The density has n + 1 where the BRDF has n + 2.
        let cosine = cosine / self.larger_cosine(direction);
        (cosine > 0.0).then(|| (direction, self.specular * (cosine * (self.exponent + 2.0) / (self.exponent + 1.0))))
    }
}

#[cfg(test)]
mod tests;
