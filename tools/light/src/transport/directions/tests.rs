//! Are guided directions distributed as they claim?

use super::super::sampling::uniform_direction;
use super::*;
use pm_random::Random;

/// Distributions of light from many directions, from one, from grazing ones, about several normals.
pub(in crate::transport) fn distributions() -> Vec<Directions> {
    let mut random = Random::new(&[21]);
    let mut made = vec![];
    for normal in [Vec3::Y, Vec3::NEG_Z, Vec3::new(1.0, -2.0, 0.5).normalize(), Vec3::new(-0.3, 0.2, 0.9).normalize()] {
        let (x, _) = frame(normal);
        let few: Vec<_> = (0..7).map(|i| uniform_direction(normal, random.unit(), i as f32 / 7.0)).collect();
        let many: Vec<_> = (0..3000).map(|_| uniform_direction(normal, random.unit(), random.unit())).collect();
        let grazing = vec![(x + normal * 0.01).normalize()];
        for directions in [vec![normal], few, many, grazing] {
            let light = directions.into_iter().map(|direction| (direction, random.unit() + 0.1)).collect::<Vec<_>>();
            // Light from below is no light.
            made.push(Directions::new(normal, light.into_iter().chain([(-normal, 1e6)])).unwrap());
        }
    }
    made
}

/// Chance of each of `8 x 16` cells of equal solid angle, by midpoint sums of the density over the hemisphere.
fn chances(directions: &Directions) -> Vec<f64> {
    // Rows of the grid end between these elevations, columns at these azimuths.
    let fine = [800, 4];
    let mut sums = vec![0.0; 128];
    let n = [8 * fine[0], 16 * fine[1]];
    for i in 0..n[0] {
        for j in 0..n[1] {
            let u = (i as f32 + 0.5) / n[0] as f32;
            let direction = uniform_direction(directions.normal, u, (j as f32 + 0.5) / n[1] as f32);
            // Uniform over the hemisphere: 2 pi / (number of points) steradians each.
            let density = f64::from(directions.density(direction) * direction.dot(directions.normal)) * 2.0;
            sums[(i / fine[0]) * 16 + j / fine[1]] += density / (n[0] * n[1]) as f64;
        }
    }
    sums
}

#[test]
fn densities_integrate_to_one_over_the_hemisphere() {
    let mut random = Random::new(&[3]);
    for directions in distributions() {
        let total: f64 = chances(&directions).iter().sum();
        assert!((total - 1.0).abs() < 2e-3, "{total}");
        for _ in 0..1000 {
            let density = directions.density(uniform_direction(directions.normal, random.unit(), random.unit()));
            // Every direction can be met, and none weighs more than twice what it would by the cosine.
            assert!(density >= COSINE_SHARE * 0.999, "{density}");
        }
    }
}

#[test]
fn samples_are_distributed_as_the_density_says() {
    let mut random = Random::new(&[4]);
    for directions in distributions() {
        let n = 100_000;
        let mut counts = vec![0.0; 128];
        let mut differing = 0;
        for _ in 0..n {
            let (direction, density) = directions.sample(random.unit(), random.unit());
            differing += u32::from((density / directions.density(direction) - 1.0).abs() > 1e-3);
            let cosine = direction.dot(directions.normal);
            let (_, v) = unit_square(directions.normal, direction);
            counts[((1.0 - cosine) * 8.0).min(7.0) as usize * 16 + ((v * 16.0) as usize).min(15)] += 1.0;
        }
        // Rounding may put a sample across the border of a cell.
        assert!(differing < n / 1000, "{differing}");
        let expected = chances(&directions);
        let square: f64 =
            counts.iter().zip(&expected).map(|(o, e)| (o - e * f64::from(n)).powi(2) / (e * f64::from(n))).sum();
        // Chi-square of 127 degrees of freedom: mean 127, deviation 16; the midpoint sums add a little.
        assert!(square < 127.0 + 6.0 * 16.0, "{square}");
    }
}

#[test]
fn strata_stay_strata() {
    for directions in distributions() {
        let mut before = 0.0;
        for i in 0..=1000u16 {
            let (_, u, density) = stretched(&directions.rows, f32::from(i) / 1001.0);
            assert!(u >= before && u <= 1.0 && density >= COSINE_SHARE * 0.999);
            before = u;
        }
    }
}
