//! A camera inside a wall: what it looks like, since nothing says so.

use super::pinhole::Camera;
use crate::scene::{MaterialKind, Scene};
use glam::DVec3;

/// Rays cast, in a grid of this many each way.
const GRID: u32 = 5;

impl Camera {
    /// Whether every surface it sees, at a grid of points of its image, turns its back to it; false if it sees none.
    /// Glass has no back: one may well look out of it.
    ///
    /// A room whose walls all face outward looks the same, so this is worth a remark and no more.
    pub fn sees_only_backs(&self, scene: &Scene) -> bool {
        let [width, height] = self.size().map(f64::from);
        let cell = |i: u32| (f64::from(i) + 0.5) / f64::from(GRID);
        let rays = (0..GRID * GRID).map(|i| self.ray(cell(i % GRID) * width, cell(i / GRID) * height));
        let mut seen = false;
        for (origin, direction) in rays {
            match faces(scene, origin.as_dvec3(), direction.as_dvec3()) {
                Some(true) => return false,
                Some(false) => seen = true,
                None => {}
            }
        }
        seen
    }
}

/// Whether the first surface on a ray faces it. A few rays are not worth a tree: all triangles are tried (Möller and
/// Trumbore, *Fast, Minimum Storage Ray/Triangle Intersection*, 1997).
fn faces(scene: &Scene, origin: DVec3, direction: DVec3) -> Option<bool> {
    let mut first = (f64::INFINITY, None);
    for i in 0..scene.triangle_count() {
        let [a, b, c] = scene.triangle(i).map(|p| p.as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let p = direction.cross(ac);
        let determinant = ab.dot(p);
        if determinant == 0.0 {
            continue;
        }
        let s = origin - a;
        let u = s.dot(p) / determinant;
        let q = s.cross(ab);
        let v = direction.dot(q) / determinant;
        let t = ac.dot(q) / determinant;
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < first.0 {
            // The determinant is minus the cosine to the normal, scaled.
            first = (t, Some(determinant > 0.0 || scene.material_of(i).kind == MaterialKind::Glass));
        }
    }
    first.1
}
