//! Where rays hit: a bounding volume hierarchy that the obvhs library builds, with a triangle test of our own.
//!
//! The library's hierarchy is binary. Rays go through an eight-wide one made of it, whose boxes and triangles are tested eight
//! at a time (`cargo bench -p pm-programs --bench rays`). The library's own eight-wide form drops hits nearer than 1e-4, and
//! sees nothing along a direction with a component of -0.0. The binary one says which triangle is the first where two are met
//! at the very same distance, as on an edge: the last on its way.
//!
//! Boxes are padded: where they are not, the rounding of the box test loses the hits of 88 of 1,363 rays through the points of
//! a lattice. Our triangle test is watertight: a ray through a shared edge hits one of the triangles.

mod lanes;
mod ray;
mod search;
mod sheared;
#[cfg(test)]
mod tests;
mod wide;

use crate::scene::Scene;
use glam::{Vec3, Vec3A};
use lanes::{Instructions, LANES};
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::{Boundable, BvhBuildParams};
use search::{Blocked, Closest, ClosestEach, First};
use sheared::Sheared;
use std::time::Duration;
use wide::Wide;

pub(super) use ray::Ray;
pub use ray::RayHit;

/// What light transport needs of a ray caster.
pub trait RayCaster: Sync {
    /// The first triangle at `0 < t <= far` from `origin` along `direction`.
    fn closest(&self, origin: Vec3, direction: Vec3, far: f32) -> Option<RayHit>;

    /// Is there any triangle at `0 < t < 1` between the two points?
    fn blocked(&self, from: Vec3, to: Vec3) -> bool;
}

/// Triangles in a bounding volume hierarchy.
pub struct Bvh {
    wide: Wide,
    instructions: Instructions,
    tree: Bvh2,
    /// In the order of the leaves, each with its index in the scene.
    triangles: Vec<([Vec3; 3], u32)>,
}

/// A triangle with a margin for the rounding of the box test.
struct Padded([Vec3; 3], f32);

impl Boundable for Padded {
    fn aabb(&self) -> Aabb {
        let corners = self.0.map(Vec3A::from);
        let margin = Vec3A::splat(self.1);
        let min = corners[0].min(corners[1]).min(corners[2]) - margin;
        let max = corners[0].max(corners[1]).max(corners[2]) + margin;
        Aabb::new(min, max)
    }
}

impl Bvh {
    /// Builds the hierarchy; the same scene gives the same one.
    #[must_use]
    pub fn build(scene: &Scene) -> Self {
        let reach = scene.bounds.min.abs().max(scene.bounds.max.abs()).max_element();
        // A few rounding steps of the largest coordinate.
        let margin = reach * 1e-6;
        let padded: Vec<_> = (0..scene.triangle_count()).map(|i| Padded(scene.triangle(i), margin)).collect();
        let build = BvhBuildParams { max_prims_per_leaf: LANES as u32, ..BvhBuildParams::medium_build() };
        let tree = build_bvh2(&padded, build, &mut Duration::default());
        let triangles: Vec<_> = tree.primitive_indices.iter().map(|&i| (padded[i as usize].0, i)).collect();
        Self { wide: Wide::new(&tree, &triangles), instructions: Instructions::best(), tree, triangles }
    }

    /// [`closest`](RayCaster::closest) of each of some rays, into `hits`: with less to do for each than one by one.
    pub(super) fn closest_each(&self, rays: &[Ray], hits: &mut Vec<Option<RayHit>>) {
        hits.clear();
        self.instructions.run(ClosestEach(&self.wide, rays, |first: Option<First>| {
            let hit = match first {
                Some(first) if first.tied => self.closest_by_binary(rays[hits.len()]),
                first => first.map(|first| first.hit),
            };
            hits.push(hit);
        }));
    }

    /// The first triangle by the binary hierarchy.
    fn closest_by_binary(&self, Ray { origin, direction, far }: Ray) -> Option<RayHit> {
        let sheared = Sheared::new(origin, direction);
        let mut best = None;
        let mut nearest = far;
        let ray = obvhs::ray::Ray::new(origin.into(), direction.into(), 0.0, far);
        self.tree.ray_traverse(ray, &mut obvhs::ray::RayHit::none(), |_, place| {
            let (corners, triangle) = &self.triangles[place];
            match sheared.hit(corners, nearest) {
                Some((t, u, v)) => {
                    nearest = t;
                    best = Some(RayHit { triangle: *triangle, t, u, v });
                    t
                }
                None => f32::INFINITY,
            }
        });
        best
    }
}

impl RayCaster for Bvh {
    fn closest(&self, origin: Vec3, direction: Vec3, far: f32) -> Option<RayHit> {
        let ray = Ray { origin, direction, far };
        let first = self.instructions.run(Closest(&self.wide, ray))?;
        if first.tied { self.closest_by_binary(ray) } else { Some(first.hit) }
    }

    fn blocked(&self, from: Vec3, to: Vec3) -> bool {
        self.instructions.run(Blocked(&self.wide, Ray { origin: from, direction: to - from, far: 1.0 }))
    }
}
