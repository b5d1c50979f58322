//! The test of a ray against one triangle.

use glam::Vec3;

/// A ray turned and sheared so that it runs along the z axis: edges shared by triangles are then judged by the very same
/// products. Woop, Benthin, Wald: *Watertight Ray/Triangle Intersection*, JCGT 2(1), 2013.
pub(super) struct Sheared {
    pub(super) origin: Vec3,
    /// Which axes are called x, y and z.
    pub(super) axes: [usize; 3],
    /// What is taken from x and y for each unit of z, and the scale of z.
    pub(super) shear: Vec3,
}

impl Sheared {
    #[inline(always)]
    pub(super) fn new(origin: Vec3, direction: Vec3) -> Self {
        // z is where the ray goes most; x and y keep the handedness.
        let size = direction.abs();
        let z = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        let shear = Vec3::new(direction[x] / direction[z], direction[y] / direction[z], 1.0 / direction[z]);
        Self { origin, axes: [x, y, z], shear }
    }

    /// Distance and barycentric weights of the second and third corner, for a hit at `0 < t <= far`.
    pub(super) fn hit(&self, corners: &[Vec3; 3], far: f32) -> Option<(f32, f32, f32)> {
        let [x, y, z] = self.axes;
        let [a, b, c] = corners.map(|corner| corner - self.origin);
        let flat = |p: Vec3| (p[x] - self.shear.x * p[z], p[y] - self.shear.y * p[z]);
        let ((ax, ay), (bx, by), (cx, cy)) = (flat(a), flat(b), flat(c));
        let mut u = cx * by - cy * bx;
        let mut v = ax * cy - ay * cx;
        let mut w = bx * ay - by * ax;
        if u == 0.0 || v == 0.0 || w == 0.0 {
            // On an edge as far as single precision can tell: double precision decides.
            let cross = |px: f32, py: f32, qx: f32, qy: f32| {
                (f64::from(px) * f64::from(qy) - f64::from(py) * f64::from(qx)) as f32
            };
            (u, v, w) = (cross(cx, cy, bx, by), cross(ax, ay, cx, cy), cross(bx, by, ax, ay));
        }
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let determinant = u + v + w;
        if determinant == 0.0 {
            return None;
        }
        let scaled = self.shear.z * (u * a[z] + v * b[z] + w * c[z]);
        let t = scaled / determinant;
        (t > 0.0 && t <= far).then(|| (t, v / determinant, w / determinant))
    }
}
