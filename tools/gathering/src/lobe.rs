//! The glossy part of a BRDF.

use glam::{DVec3, Vec3};
use pm_formats::{Material, Query};
use std::f64::consts::PI;

/// The glossy part of a BRDF: Phong's lobe about the mirrored direction of view, over the larger of the two cosines so
/// that little is lost at grazing angles: Neumann, Neumann, Szirmay-Kalos, *Compact Metallic Reflectance Models*,
/// Eurographics 1999. It is the BRDF that photons and gather rays were scattered by.
pub(super) struct Lobe {
    /// Specular reflectance times (n + 2) / (2 pi), per steradian.
    peak: [f64; 3],
    exponent: f64,
    mirrored_view: DVec3,
    normal: DVec3,
    view_cosine: f64,
}

/// Directions are packed: one along the surface may seem to come from below.
const LEAST_COSINE: f64 = 1e-4;

/// Does a surface of this material have a lobe?
pub(super) fn is_glossy(material: &Material) -> bool {
    !material.specular.iter().all(|&share| share <= 0.0)
}

impl Lobe {
    /// That of a surface seen by a query, if it is glossy.
    pub(super) fn of(material: &Material, query: &Query) -> Option<Self> {
        if !is_glossy(material) {
            return None;
        }
        let exponent = f64::from(material.exponent);
        let (normal, view) = (Vec3::from(query.normal()).as_dvec3(), Vec3::from(query.view()).as_dvec3());
        Some(Self {
            peak: material.specular.map(|share| f64::from(share) * (exponent + 2.0) / (2.0 * PI)),
            exponent,
            mirrored_view: normal * (2.0 * normal.dot(view)) - view,
            normal,
            view_cosine: normal.dot(view),
        })
    }

    /// For light from this direction, per steradian.
    pub(super) fn brdf(&self, towards_source: [f32; 3]) -> [f64; 3] {
        let source = Vec3::from(towards_source).as_dvec3();
        let larger = self.view_cosine.max(self.normal.dot(source)).max(LEAST_COSINE);
        let lobe = libm::pow(self.mirrored_view.dot(source).clamp(0.0, 1.0), self.exponent) / larger;
        self.peak.map(|peak| peak * lobe)
    }
}
