//! Directions and strata.

use super::turn::sin_cos_of_turn;
use glam::Vec3;
use pm_film::hemisphere::frame;

/// A direction about `normal`, distributed as the cosine of the angle to it, from two numbers in [0, 1): the first is the
/// squared sine of the elevation, the second the azimuth.
#[must_use]
pub(super) fn cosine_direction(normal: Vec3, u: f32, v: f32) -> Vec3 {
    cosine_direction_in(frame(normal), normal, u, v)
}

/// As [`cosine_direction`], for the frame about a normal that is known.
#[must_use]
#[inline]
pub(super) fn cosine_direction_in((x, y): (Vec3, Vec3), normal: Vec3, u: f32, v: f32) -> Vec3 {
    let (sin, cos) = (u.sqrt(), (1.0 - u).sqrt());
    let (sin_phi, cos_phi) = sin_cos_of_turn(v);
    (x * (sin * cos_phi) + y * (sin * sin_phi) + normal * cos).normalize()
}

/// [`cosine_direction_in`] of each of some pairs of numbers, after those that are there already.
pub(super) fn cosine_directions_in(
    frame: (Vec3, Vec3),
    normal: Vec3,
    numbers: &[(f32, f32)],
    directions: &mut Vec<Vec3>,
) {
    const LANES: usize = 8;
    for numbers in numbers.chunks(LANES) {
        // Side by side, so that no direction waits for the roots and quotients of another; what is too much is not taken.
        let (mut u, mut v) = ([0.0; LANES], [0.0; LANES]);
        for (lane, &number) in numbers.iter().enumerate() {
            (u[lane], v[lane]) = number;
        }
        let mut weights = [[0.0; LANES]; 3];
        for lane in 0..LANES {
            let (sin, cos) = (u[lane].sqrt(), (1.0 - u[lane]).sqrt());
            let (sin_phi, cos_phi) = sin_cos_of_turn(v[lane]);
            weights[0][lane] = sin * cos_phi;
            weights[1][lane] = sin * sin_phi;
            weights[2][lane] = cos;
        }
        let mut made = [[0.0; LANES]; 3];
        for axis in 0..3 {
            let (x, y, normal) = (frame.0[axis], frame.1[axis], normal[axis]);
            for lane in 0..LANES {
                made[axis][lane] = x * weights[0][lane] + y * weights[1][lane] + normal * weights[2][lane];
            }
        }
        let [x, y, z] = &mut made;
        for lane in 0..LANES {
            // As `normalize` does.
            let scale = 1.0 / (x[lane] * x[lane] + y[lane] * y[lane] + z[lane] * z[lane]).sqrt();
            (x[lane], y[lane], z[lane]) = (x[lane] * scale, y[lane] * scale, z[lane] * scale);
        }
        directions.extend((0..numbers.len()).map(|lane| Vec3::new(x[lane], y[lane], z[lane])));
    }
}

/// A direction about `normal`, spread evenly over the hemisphere, from two numbers in [0, 1).
#[must_use]
pub(super) fn uniform_direction(normal: Vec3, u: f32, v: f32) -> Vec3 {
    // 1 - u and not u: the first number is the elevation from the normal outward, as for the cosine.
    around(normal, 1.0 - u, v)
}

/// A direction about `axis`, distributed as the n-th power of the cosine of the angle to it (Lafortune and Willems, 1994,
/// equation 8); it may lie below the surface.
#[must_use]
pub(super) fn phong_direction(axis: Vec3, exponent: f32, u: f32, v: f32) -> Vec3 {
    around(axis, libm::powf(1.0 - u, 1.0 / (exponent + 1.0)), v)
}

/// The direction at an angle to `axis` whose cosine is `cos`, at the share `v` of a turn about it.
fn around(axis: Vec3, cos: f32, v: f32) -> Vec3 {
    let sin = ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt();
    let (sin_phi, cos_phi) = sin_cos_of_turn(v);
    let (x, y) = frame(axis);
    (x * (sin * cos_phi) + y * (sin * sin_phi) + axis * cos).normalize()
}

/// Rows and columns of the most nearly square grid of `n` cells, rows (elevations) at most as many as columns.
#[must_use]
pub(super) fn grid(n: u32) -> (u32, u32) {
    let root = (1..).take_while(|root| root * root <= u64::from(n)).last().unwrap_or(1);
    let rows = (1..=u32::try_from(root).unwrap_or(1)).rev().find(|rows| n.is_multiple_of(*rows)).unwrap_or(1);
    (rows, n / rows)
}

/// Weights of a triangle's second and third corner for a point spread evenly over it.
#[must_use]
pub(super) fn triangle_point(u: f32, v: f32) -> (f32, f32) {
    let root = u.sqrt();
    (root * (1.0 - v), root * v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_random::Random;

    #[test]
    fn grids_are_as_square_as_they_can_be() {
        assert_eq!([100, 64, 1, 7, 12, 50, 2].map(grid), [(10, 10), (8, 8), (1, 1), (1, 7), (3, 4), (5, 10), (1, 2)]);
    }

    #[test]
    fn cosine_directions_have_the_moments_of_the_cosine() {
        // Mean cosine 2/3; mean of the tangent parts 0; mean square of each tangent part 1/4.
        for normal in [Vec3::Y, Vec3::NEG_Z, Vec3::new(1.0, -2.0, 0.5).normalize()] {
            let mut random = Random::new(&[1]);
            let (x, y) = frame(normal);
            assert!(x.cross(y).distance(normal) < 1e-5);
            let n = 100_000;
            let mut sums = [0f64; 4];
            for _ in 0..n {
                let direction = cosine_direction(normal, random.unit(), random.unit());
                assert!((direction.length() - 1.0).abs() < 1e-5);
                let (a, b) = (direction.dot(x), direction.dot(y));
                for (sum, value) in sums.iter_mut().zip([direction.dot(normal), a, b, a * a]) {
                    *sum += f64::from(value) / f64::from(n);
                }
            }
            for (sum, expected) in sums.into_iter().zip([2.0 / 3.0, 0.0, 0.0, 0.25]) {
                assert!((sum - expected).abs() < 0.006, "{sums:?}");
            }
        }
    }

    #[test]
    fn directions_side_by_side_are_those_one_by_one_to_the_bit() {
        let mut random = Random::new(&[4]);
        for n in [0, 1, 7, 8, 9, 100] {
            let normal = Vec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalize();
            let numbers: Vec<_> = (0..n).map(|_| (random.unit(), random.unit())).collect();
            let mut directions = vec![Vec3::X];
            cosine_directions_in(frame(normal), normal, &numbers, &mut directions);
            let one_by_one = numbers.iter().map(|&(u, v)| cosine_direction(normal, u, v));
            assert_eq!(directions, [Vec3::X].into_iter().chain(one_by_one).collect::<Vec<_>>());
        }
    }

    #[test]
    fn triangle_points_are_spread_evenly() {
        let mut random = Random::new(&[2]);
        let n = 100_000;
        let mut mean = [0f64; 2];
        for _ in 0..n {
            let (u, v) = triangle_point(random.unit(), random.unit());
            assert!(u >= 0.0 && v >= 0.0 && u + v <= 1.000_001);
            mean[0] += f64::from(u) / f64::from(n);
            mean[1] += f64::from(v) / f64::from(n);
        }
        assert!((mean[0] - 1.0 / 3.0).abs() < 0.004 && (mean[1] - 1.0 / 3.0).abs() < 0.004, "{mean:?}");
    }
}
