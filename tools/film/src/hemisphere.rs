//! A frame for the hemisphere above a surface: the rays of a point and the gradients made from them share it.

use glam::Vec3;

/// Two unit vectors that complete `normal` to a right-handed frame. Azimuth 0 is along the first, a quarter turn along the
/// second.
///
/// Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin: *Building an Orthonormal Basis, Revisited*, JCGT 6(1), 2017.
#[must_use]
pub fn frame(normal: Vec3) -> (Vec3, Vec3) {
    let sign = 1f32.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    let x = Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    let y = Vec3::new(b, sign + normal.y * normal.y * a, -normal.y);
    (x, y)
}
