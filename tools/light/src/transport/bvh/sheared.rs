//! The test of a ray against one triangle.

use glam::Vec3;

/// A ray turned and sheared so that it runs along the z axis: edges shared by triangles are then judged by the very same
/// products. Woop, Benthin, Wald: *Watertight Ray/Triangle Intersection*, JCGT 2(1), 2013.
#[derive(Clone, Copy)]
pub(super) struct Sheared {
    /// Along the axes in the ray's order.
    pub(super) origin: [f32; 3],
    /// Which axes are called x, y and z.
    pub(super) axes: [usize; 3],
    /// What is taken from x and y for each unit of z, and the scale of z.
    pub(super) shear: [f32; 3],
}

/// By the axis called z: those called x and y, which keep the handedness, where the ray goes up z and where it goes down.
const OTHERS: [[[usize; 2]; 2]; 3] = [[[1, 2], [2, 1]], [[2, 0], [0, 2]], [[0, 1], [1, 0]]];

impl Sheared {
    #[inline(always)]
    pub(super) fn new(origin: Vec3, direction: Vec3) -> Self {
        // z is where the ray goes most.
        let size = direction.abs();
        let y_or_z = 1 + usize::from(size.y < size.z);
        let z = if (size.x >= size.y) & (size.x >= size.z) { 0 } else { y_or_z };
        let (origin, direction) = (origin.to_array(), direction.to_array());
        let [x, y] = OTHERS[z][usize::from(direction[z] < 0.0)];
        let axes = [x, y, z];
        let shear = [direction[x] / direction[z], direction[y] / direction[z], 1.0 / direction[z]];
        Self { origin: axes.map(|axis| origin[axis]), axes, shear }
    }

    /// Distance and barycentric weights of the second and third corner, for a hit at `0 < t <= far`.
    pub(super) fn hit(&self, corners: &[Vec3; 3], far: f32) -> Option<(f32, f32, f32)> {
        let [a, b, c] = corners.map(|corner| {
            let corner = corner.to_array();
            [0, 1, 2].map(|axis| corner[self.axes[axis]] - self.origin[axis])
        });
        let [shear_x, shear_y, scale] = self.shear;
        let flat = |[x, y, z]: [f32; 3]| (x - shear_x * z, y - shear_y * z);
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
        let scaled = scale * (u * a[2] + v * b[2] + w * c[2]);
        let t = scaled / determinant;
        (t > 0.0 && t <= far).then(|| (t, v / determinant, w / determinant))
    }
}
