//! The search for one site.

use super::{PrecomputedIrradiance, Site};
use crate::surface::{coarse, on_same_surface};
use pm_maps::geometry::distance_squared;
use pm_maps::{AccessObserver, rank};

/// Deepest tree of at most 2^30 nodes, and one more.
const MAX_DEPTH: usize = 32;
/// A site farther than this share of its reach from the tangent plane of the point that asks is of another surface: a step, a
/// shelf, a bump. Where the point is on a sphere of a radius as large as the reach, the site at half the reach is as far.
const FARTHEST_FROM_PLANE: f32 = 1.0 / 8.0;

impl Site {
    /// Does it know of the surface at a point, at this squared distance, with this unit normal?
    fn knows(&self, point: [f32; 3], normal: [f32; 3], distance_squared: f32) -> bool {
        let reach = self.reach_squared();
        let height: f32 = (0..3).map(|axis| (self.position[axis] - point[axis]) * normal[axis]).sum();
        distance_squared <= reach
            && height * height <= reach * (FARTHEST_FROM_PLANE * FARTHEST_FROM_PLANE)
            && on_same_surface(coarse(self.normal()), normal)
    }
}

impl PrecomputedIrradiance<'_> {
    /// Index of the site nearest to `point` among those that know of its surface, ties by photon id.
    ///
    /// Jensen's walk with a bound that shrinks to the nearest found. A site is looked at before those below it, so that
    /// the bound is small as early as can be.
    pub(super) fn nearest(&self, point: [f32; 3], normal: [f32; 3], eyes: &mut impl AccessObserver) -> Option<usize> {
        let count = self.sites.len();
        let (mut nearest, mut best) = (None, rank(self.bound, u32::MAX));
        let mut bound = self.bound;
        // Second children yet to be looked at, with the squared distance to the plane before them.
        let mut waiting = [(0u32, 0f32); MAX_DEPTH];
        let mut depth = 0;
        let mut at = usize::from(count > 0);
        while at != 0 {
            let site = &self.sites[at - 1];
            eyes.read(self.region, (at - 1) as u32);
            let distance = distance_squared(point, site.position);
            // Not `<`: one as far as the nearest may have the smaller id. Also false for NaN.
            if distance <= bound {
                let mine = rank(distance, self.ids[at - 1]);
                if mine < best && site.knows(point, normal, distance) {
                    (nearest, best, bound) = (Some(at - 1), mine, distance);
                }
            }
            let axis = site.axis();
            let delta = point[axis] - site.position[axis];
            let (near, far) = if delta > 0.0 { (2 * at + 1, 2 * at) } else { (2 * at, 2 * at + 1) };
            if far <= count {
                waiting[depth] = (far as u32, delta * delta);
                depth += 1;
            }
            at = if near <= count { near } else { 0 };
            while at == 0 && depth > 0 {
                depth -= 1;
                let (far, plane) = waiting[depth];
                at = if plane <= bound { far as usize } else { 0 };
            }
        }
        nearest
    }
}
