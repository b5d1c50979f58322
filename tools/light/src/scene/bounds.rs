//! Axis-aligned boxes.

use glam::Vec3;

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its corner of least coordinates.
    pub min: Vec3,
    /// Its corner of greatest coordinates.
    pub max: Vec3,
}

impl Bounds {
    /// The smallest box around these points; inside out if there are none.
    pub(super) fn around(points: impl Iterator<Item = Vec3>) -> Self {
        let empty = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };
        points.fold(empty, |bounds, p| Self { min: bounds.min.min(p), max: bounds.max.max(p) })
    }

    /// The middle of the box.
    pub fn centre(&self) -> Vec3 {
        ((self.min.as_dvec3() + self.max.as_dvec3()) / 2.0).as_vec3()
    }

    /// The lengths of its sides.
    pub fn size(&self) -> Vec3 {
        self.max - self.min
    }
}
