//! Points on surfaces: where a ray hit, and how to leave again without hitting the same surface.

use super::bvh::{Bvh, RayCaster};
use crate::scene::{Material, Scene};
use glam::Vec3;
use std::sync::Arc;

/// A scene made ready for rays. Copies share what was built.
#[derive(Clone)]
pub struct Surfaces<'a> {
    /// What is lit.
    pub scene: &'a Scene,
    built: Arc<Built>,
}

struct Built {
    bvh: Bvh,
    normals: Vec<Vec3>,
}

impl<'a> From<&'a Scene> for Surfaces<'a> {
    fn from(scene: &'a Scene) -> Self {
        Self::new(scene)
    }
}

/// A point where a ray met a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// The point; exactly on an axis-aligned wall.
    pub position: Vec3,
    /// Unit normal of the triangle, on its front side (the outside of glass).
    pub front: Vec3,
    /// Unit normal of the triangle on the side that the ray came from.
    pub facing: Vec3,
    /// Interpolated normal on the front side, for reflection and refraction; `front` where the surface is flat.
    pub smooth: Vec3,
    /// Material, an index into the scene's.
    pub material: u16,
    /// Triangle, an index into the scene's.
    pub triangle: u32,
    /// How far a ray must start from the surface so that rounding does not put it on the wrong side.
    margin: f32,
}

/// Share of the coordinates and of the triangle's size that separates a ray's start from the surface: some 16 rounding
/// steps, in whatever unit the scene is.
const MARGIN: f32 = 1.0 / (1 << 20) as f32;

impl<'a> Surfaces<'a> {
    /// Builds what rays need.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        let normals = (0..scene.triangle_count()).map(|i| scene.geometric_normal(i)).collect();
        Self { scene, built: Arc::new(Built { bvh: Bvh::build(scene), normals }) }
    }

    /// The first surface that a ray meets.
    #[must_use]
    pub fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let hit = self.built.bvh.closest(origin, direction, f32::INFINITY)?;
        let index = hit.triangle as usize;
        let [a, b, c] = self.scene.triangle(index);
        let (ab, ac) = (b - a, c - a);
        // From the corners and not along the ray: coordinates that the corners share stay exact.
        let position = a + ab * hit.u + ac * hit.v;
        let front = self.built.normals[index];
        let smooth = match self.scene.corner_normals(index) {
            Some([na, nb, nc]) => (na * (1.0 - hit.u - hit.v) + nb * hit.u + nc * hit.v).normalize_or(front),
            None => front,
        };
        Some(SurfacePoint {
            position,
            front,
            facing: if direction.dot(front) > 0.0 { -front } else { front },
            smooth,
            material: self.scene.material_ids[index],
            triangle: hit.triangle,
            margin: MARGIN * (position.abs().max_element() + ab.abs().max(ac.abs()).max_element()),
        })
    }

    /// Is the way between two points blocked?
    #[must_use]
    pub fn blocked(&self, from: Vec3, to: Vec3) -> bool {
        self.built.bvh.blocked(from, to)
    }

    /// What a point's surface is made of.
    #[must_use]
    pub fn material(&self, point: &SurfacePoint) -> &'a Material {
        &self.scene.materials[usize::from(point.material)]
    }

    /// A point of a triangle by barycentric weights of its second and third corner, lifted off its front.
    #[must_use]
    pub fn point_before(&self, triangle: usize, u: f32, v: f32) -> (Vec3, Vec3) {
        let [a, b, c] = self.scene.triangle(triangle);
        let (ab, ac) = (b - a, c - a);
        let position = a + ab * u + ac * v;
        let margin = MARGIN * (position.abs().max_element() + ab.abs().max(ac.abs()).max_element());
        (position + self.built.normals[triangle] * margin, self.built.normals[triangle])
    }
}

impl SurfacePoint {
    /// Where a ray that leaves in `direction` starts.
    #[must_use]
    pub fn start(&self, direction: Vec3) -> Vec3 {
        let side = if direction.dot(self.front) < 0.0 { -self.front } else { self.front };
        self.position + side * self.margin
    }
}
