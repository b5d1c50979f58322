//! From faces to triangles: polygons are cut, triangles without area dropped, windings turned to agree with normals.

use glam::{DVec3, Vec3};

/// Triangles whose height is a smaller share of their longest side have no normal worth the name in single precision.
const FLATTEST: f64 = 1e-8;
/// Starting corners tried for the fan of a concave polygon: bounds the work on polygons of very many corners.
const STARTS: usize = 64;

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

/// The corner from which a polygon can be cut as a fan: the first one if that will do, which it does for all convex
/// polygons; for a quadrangle with a dent, the dent. `None` if the first few corners will not do.
pub(crate) fn fan_start(polygon: &[Vec3]) -> Option<usize> {
    let n = polygon.len();
    let origin = polygon[0].as_dvec3();
    let points: Vec<DVec3> = polygon.iter().map(|p| p.as_dvec3() - origin).collect();
    // Newell's sum: twice the area of the polygon, along its normal, whatever its shape.
    let normal: DVec3 = (0..n).map(|i| points[i].cross(points[(i + 1) % n])).sum();
    let slack = -1e-6 * normal.length_squared();
    let fans = |start: &usize| {
        (1..n - 1).all(|i| {
            let [a, b, c] = [points[*start], points[(start + i) % n], points[(start + i + 1) % n]];
            (b - a).cross(c - a).dot(normal) >= slack
        })
    };
    (0..n.min(STARTS)).find(fans)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(points: &[[f32; 2]]) -> Vec<Vec3> {
        points.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect()
    }

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

    /// Is a convex polygon cut from its first corner, and a dented one from where the cut stays inside?
    #[test]
    fn dented_quadrangle_is_cut_at_the_dent() {
        assert_eq!(fan_start(&flat(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]])), Some(0));
        let arrow = [[1., 1.], [-1., 0.], [1., -1.], [0., 0.]];
        for turn in 0..4 {
            let mut points = flat(&arrow);
            points.rotate_left(turn);
            let start = fan_start(&points).unwrap();
            let cut =
                if (points[start] - Vec3::ZERO).length() == 0.0 { true } else { points[(start + 2) % 4] == Vec3::ZERO };
            assert!(cut, "turned by {turn}");
        }
    }

    /// Is a polygon that no fan can cut reported rather than cut wrongly in silence?
    #[test]
    fn comb_has_no_fan() {
        let comb = [[0., 0.], [6., 0.], [6., 3.], [5., 1.], [4., 3.], [3., 1.], [2., 3.], [1., 1.], [0., 3.]];
        assert_eq!(fan_start(&flat(&comb)), None);
    }
}
