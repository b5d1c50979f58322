//! Points on surfaces: where a ray hit, and how to leave again without hitting the same surface.

use super::bvh::{Bvh, Ray, RayCaster, RayHit};
use crate::scene::{Material, MaterialKind, Scene};
use glam::Vec3;
use pm_formats::Query;
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
    facets: Vec<Facet>,
}

/// What is asked of a triangle wherever it is met, in one place.
#[derive(Clone, Copy)]
struct Facet {
    corner: Vec3,
    /// From that corner to the second and to the third.
    edges: [Vec3; 2],
    /// Unit normal.
    front: Vec3,
    /// As queries carry it, on the front side and on the other.
    packed: [u32; 2],
    material: u16,
    /// Is the normal at its points another than its own, and asked for?
    is_smooth: bool,
}

impl Facet {
    fn new(scene: &Scene, triangle: usize) -> Self {
        let [a, b, c] = scene.triangle(triangle);
        let bends = matches!(scene.material_of(triangle).kind, MaterialKind::Mirror | MaterialKind::Glass);
        let front = scene.geometric_normal(triangle);
        Self {
            corner: a,
            edges: [b - a, c - a],
            front,
            packed: [front, -front].map(|normal| Query::pack_vector(normal.into())),
            material: scene.material_ids[triangle],
            is_smooth: bends && scene.corner_normals(triangle).is_some(),
        }
    }

    /// The point with these weights of the second and third corner, and how far a ray must start from it.
    fn point(&self, u: f32, v: f32) -> (Vec3, f32) {
        let [ab, ac] = self.edges;
        // From the corners and not along the ray: coordinates that the corners share stay exact.
        let position = self.corner + ab * u + ac * v;
        (position, MARGIN * (position.abs().max_element() + ab.abs().max(ac.abs()).max_element()))
    }
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
    /// Interpolated normal on the front side, for reflection and refraction; `front` where the surface is flat, or neither a
    /// mirror nor glass.
    pub smooth: Vec3,
    /// Material, an index into the scene's.
    pub material: u16,
    /// Triangle, an index into the scene's.
    pub triangle: u32,
    /// `facing` as queries carry it.
    pub(super) packed_facing: u32,
    /// How far a ray must start from the surface so that rounding does not put it on the wrong side.
    margin: f32,
}

/// What a query says of a point.
pub(super) struct Met {
    pub(super) position: Vec3,
    /// Unit normal on the side that the ray came from, as queries carry it.
    pub(super) packed_facing: u32,
    pub(super) material: u16,
}

/// Share of the coordinates and of the triangle's size that separates a ray's start from the surface: some 16 rounding
/// steps, in whatever unit the scene is.
const MARGIN: f32 = 1.0 / (1 << 20) as f32;

impl<'a> Surfaces<'a> {
    /// Builds what rays need.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        let facets = (0..scene.triangle_count()).map(|i| Facet::new(scene, i)).collect();
        Self { scene, built: Arc::new(Built { bvh: Bvh::build(scene), facets }) }
    }

    /// The first surface that a ray meets.
    #[must_use]
    #[inline]
    pub fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        let hit = self.built.bvh.closest(origin, direction, f32::INFINITY)?;
        Some(self.point(hit, direction))
    }

    /// The first triangles that rays meet, into `hits`.
    pub(super) fn hit_each(&self, rays: &[Ray], hits: &mut Vec<Option<RayHit>>) {
        self.built.bvh.closest_each(rays, hits);
    }

    /// What is asked there of most: a part of [`point`](Self::point).
    #[inline]
    pub(super) fn met(&self, hit: &RayHit, direction: Vec3) -> Met {
        let facet = &self.built.facets[hit.triangle as usize];
        let (position, _) = facet.point(hit.u, hit.v);
        let from_behind = direction.dot(facet.front) > 0.0;
        Met { position, packed_facing: facet.packed[usize::from(from_behind)], material: facet.material }
    }

    /// The point where a ray of this direction met a triangle.
    #[inline]
    pub(super) fn point(&self, hit: RayHit, direction: Vec3) -> SurfacePoint {
        let index = hit.triangle as usize;
        let facet = &self.built.facets[index];
        let (position, margin) = facet.point(hit.u, hit.v);
        let front = facet.front;
        let normals = if facet.is_smooth { self.scene.corner_normals(index) } else { None };
        let smooth = match normals {
            Some([na, nb, nc]) => (na * (1.0 - hit.u - hit.v) + nb * hit.u + nc * hit.v).normalize_or(front),
            None => front,
        };
        let from_behind = direction.dot(front) > 0.0;
        SurfacePoint {
            position,
            front,
            facing: if from_behind { -front } else { front },
            smooth,
            packed_facing: facet.packed[usize::from(from_behind)],
            material: facet.material,
            triangle: hit.triangle,
            margin,
        }
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
        let facet = &self.built.facets[triangle];
        let (position, margin) = facet.point(u, v);
        (position + facet.front * margin, facet.front)
    }
}

impl SurfacePoint {
    /// Where a ray that leaves in `direction` starts.
    #[must_use]
    #[inline]
    pub fn start(&self, direction: Vec3) -> Vec3 {
        let side = if direction.dot(self.front) < 0.0 { -self.front } else { self.front };
        self.position + side * self.margin
    }
}
