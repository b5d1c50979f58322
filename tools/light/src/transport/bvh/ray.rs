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
pub(in crate::transport) struct Ray {
    pub(in crate::transport) origin: Vec3,
    pub(in crate::transport) direction: Vec3,
    pub(in crate::transport) far: f32,
}
