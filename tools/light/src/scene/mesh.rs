//! Triangles: those without an area are told from others, and windings are compared with normals.

use glam::{DVec3, Vec3};

/// Triangles whose height is a smaller share of their longest side have no normal worth the name in single precision.
const FLATTEST: f64 = 1e-8;

/// How many triangles were left out because they have no area.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Dropped {
    /// Triangles with the same point at two corners.
    pub repeated_corner: usize,
    /// Triangles of three different points on one line, or so nearly that they have no normal.
    pub zero_area: usize,
}

impl Dropped {
    /// All of them.
    pub fn total(self) -> usize {
        self.repeated_corner + self.zero_area
    }
}

/// The cross product of two sides, `(b - a) x (c - a)`: twice the area, along the normal.
pub(crate) fn cross([a, b, c]: [Vec3; 3]) -> DVec3 {
    let a = a.as_dvec3();
    (b.as_dvec3() - a).cross(c.as_dvec3() - a)
}

/// What a triangle of these corners is.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    Sound,
    RepeatedCorner,
    ZeroArea,
}

pub(crate) fn shape(corners: [Vec3; 3]) -> Shape {
    let [a, b, c] = corners;
    if a == b || b == c || c == a {
        return Shape::RepeatedCorner;
    }
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    let longest_squared = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    // Asked this way round so that what is not a number counts as no area.
    if cross(corners).length() > FLATTEST * longest_squared { Shape::Sound } else { Shape::ZeroArea }
}

/// Whether a triangle is wound against the normals of its corners.
pub(crate) fn wound_against(corners: [Vec3; 3], normals: [Vec3; 3]) -> bool {
    let mean: DVec3 = normals.iter().map(|n| n.as_dvec3()).sum();
    cross(corners).dot(mean) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Is a needle kept at any scale and distance, and only a triangle without a normal dropped?
    #[test]
    fn shape_does_not_depend_on_scale() {
        for scale in [1e-12, 1e-6, 1.0, 1e6, 1e12] {
            let at = |x: f32, y: f32| Vec3::new(x * scale, y * scale, 0.0);
            assert_eq!(shape([at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1e-4)]), Shape::Sound);
            assert_eq!(shape([at(0.0, 0.0), at(1.0, 0.0), at(0.5, 0.0)]), Shape::ZeroArea);
            assert_eq!(shape([at(0.0, 0.0), at(1.0, 0.0), at(1.0, 0.0)]), Shape::RepeatedCorner);
        }
        assert_eq!(shape([Vec3::ZERO, Vec3::X, Vec3::NAN]), Shape::ZeroArea);
    }
}
