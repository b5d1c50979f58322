//! A ray, and where it hits.

use glam::Vec3;

/// The first triangle that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// Index of the triangle in the scene.
    pub triangle: u32,
    /// Distance in units of the ray's direction.
    pub t: f32,
    /// Barycentric weight of the triangle's second corner.
    pub u: f32,
    /// Barycentric weight of its third corner.
    pub v: f32,
}

/// A ray, and how far it goes.
#[derive(Clone, Copy)]
pub(super) struct Ray {
    pub(super) origin: Vec3,
    pub(super) direction: Vec3,
    pub(super) far: f32,
}
