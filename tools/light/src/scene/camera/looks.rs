//! What a camera sees, tried with a few rays: is it worth a picture?

use super::pinhole::Camera;
use crate::scene::{MaterialKind, Scene};
use glam::DVec3;

/// Rays cast, in a grid of this many each way.
const GRID: u32 = 5;
/// Lamps that are looked for from a point, spread over all there are.
const LAMPS: usize = 8;

impl Camera {
    /// Whether every surface it sees, at a grid of points of its image, turns its back to it; false if it sees none.
    /// Glass has no back: one may well look out of it.
    ///
    /// A room whose walls all face outward looks the same, so this is worth a remark and no more.
    pub fn sees_only_backs(&self, scene: &Scene) -> bool {
        let mut seen = false;
        for (origin, direction) in self.grid() {
            match first_hit(scene, origin, direction, |_| true) {
                Some(hit) if hit.is_front || scene.material_of(hit.triangle).kind == MaterialKind::Glass => {
                    return false;
                }
                Some(_) => seen = true,
                None => {}
            }
        }
        seen
    }

    /// Whether it sees, at a grid of points of its image, a lamp or a surface that one shines upon from this side. Glass
    /// hides no lamp.
    pub(super) fn sees_light(&self, scene: &Scene) -> bool {
        let lights = scene.lights();
        let lamps: Vec<usize> =
            lights.iter().step_by(lights.len().div_ceil(LAMPS).max(1)).map(|light| light.triangle as usize).collect();
        self.grid().any(|(origin, direction)| {
            let Some(hit) = first_hit(scene, origin, direction, |_| true) else { return false };
            if hit.is_front && scene.material_of(hit.triangle).emits() {
                return true;
            }
            // A little before the surface.
            let point = origin + direction * (hit.t * (1.0 - 1e-4));
            lamps.iter().any(|&lamp| shines_upon(scene, lamp, hit.triangle, point))
        })
    }

    fn grid(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        let [width, height] = self.size().map(f64::from);
        let cell = |i: u32| (f64::from(i) + 0.5) / f64::from(GRID);
        (0..GRID * GRID).map(move |i| {
            let (origin, direction) = self.ray(cell(i % GRID) * width, cell(i / GRID) * height);
            (origin.as_dvec3(), direction.as_dvec3())
        })
    }
}

/// Whether the middle of a lamp shines upon a surface, at a point a little before it.
fn shines_upon(scene: &Scene, lamp: usize, surface: usize, point: DVec3) -> bool {
    let middle = scene.triangle(lamp).iter().map(|corner| corner.as_dvec3()).sum::<DVec3>() / 3.0;
    let way = middle - point;
    let normal = |triangle: usize| scene.geometric_normal(triangle).as_dvec3();
    let on_surface = scene.triangle(surface)[0].as_dvec3();
    let side = normal(surface) * (point - on_surface).dot(normal(surface));
    if way.dot(normal(lamp)) >= 0.0 || way.dot(side) <= 0.0 {
        return false;
    }
    let blocks = |triangle: usize| triangle != lamp && scene.material_of(triangle).kind != MaterialKind::Glass;
    first_hit(scene, point, way, blocks).is_none_or(|hit| hit.t >= 1.0)
}

/// The first surface on a ray.
pub(super) struct Hit {
    triangle: usize,
    /// Distance in units of the direction.
    pub(super) t: f64,
    is_front: bool,
}

/// The first of the triangles asked for on a ray. A few rays are not worth a tree: all triangles are tried (Möller and
/// Trumbore, *Fast, Minimum Storage Ray/Triangle Intersection*, 1997).
pub(super) fn first_hit(scene: &Scene, origin: DVec3, direction: DVec3, of: impl Fn(usize) -> bool) -> Option<Hit> {
    let mut first: Option<Hit> = None;
    for triangle in 0..scene.triangle_count() {
        let [a, b, c] = scene.triangle(triangle).map(|p| p.as_dvec3());
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
        let is_nearer = t > 0.0 && first.as_ref().is_none_or(|hit| t < hit.t);
        if is_nearer && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && of(triangle) {
            // The determinant is minus the cosine to the normal, scaled.
            first = Some(Hit { triangle, t, is_front: determinant > 0.0 });
        }
    }
    first
}
