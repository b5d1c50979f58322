//! Irradiance and its gradients, as sums over the rays of a record.
//!
//! Ward, Heckbert: *Irradiance Gradients*, Eurographics Workshop on Rendering 1992, section 3: with M elevations (evenly
//! spaced in the square of their sine) and N azimuths. All of them are linear in the radiances, so each ray has fixed
//! coefficients, known from the geometry, and the sums can be made in any order.

use crate::hemisphere::frame;
use glam::Vec3;
use pm_formats::IrradianceRecord;
use std::f32::consts::PI;

/// What one ray's radiance is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// In the irradiance.
    pub irradiance: f32,
    /// In the change per cross product of the normals.
    pub rotation: Vec3,
    /// In the change per displacement, 1 / scene unit.
    pub translation: Vec3,
}

/// The coefficients of a record's rays, by sample number.
#[must_use]
pub fn coefficients(record: &IrradianceRecord) -> Vec<Coefficients> {
    let [rows, columns] = record.strata;
    let (x, y) = frame(Vec3::from(record.normal));
    let around = |turn: f32| {
        let (sin, cos) = libm::sincosf(2.0 * PI * turn / columns as f32);
        (x * cos + y * sin, y * cos - x * sin)
    };
    // Sine and cosine at the lower edge of a ring of strata.
    let sine = |row: u32| (row as f32 / rows as f32).sqrt();
    let cosine_squared = |row: u32| 1.0 - row as f32 / rows as f32;
    let each = PI / (rows * columns) as f32;
    let mut all: Vec<Coefficients> = (0..rows * columns)
        .map(|sample| {
            let (row, column) = (sample / columns, sample % columns);
            // The tangent in the middle of the stratum, by area.
            let u = (row as f32 + 0.5) / rows as f32;
            let (_, across) = around(column as f32 + 0.5);
            // Turned about `across` by e the ray's cosine grows by e times the sine: relative to the cosine, the tangent.
            let rotation = across * (each * (u / (1.0 - u)).sqrt());
            Coefficients { irradiance: each, rotation, translation: Vec3::ZERO }
        })
        .collect();
    let length = |sample: u32| record.rays[sample as usize].length;
    let mut difference = |more: u32, less: u32, factor: Vec3| {
        // A wall that both rays miss, or hit at no distance, moves nothing that can be told.
        let nearer = length(more).min(length(less));
        let step = factor / nearer;
        if nearer > 0.0 && step.is_finite() {
            all[more as usize].translation += step;
            all[less as usize].translation -= step;
        }
    };
    for column in 0..columns {
        let (outward, _) = around(column as f32 + 0.5);
        for row in 1..rows {
            let factor = 2.0 * PI / columns as f32 * sine(row) * cosine_squared(row);
            difference(row * columns + column, (row - 1) * columns + column, outward * factor);
        }
        // The boundary between this azimuth and the one before; a single azimuth has none.
        let before = (column + columns - 1) % columns;
        let (_, across) = around(column as f32);
        for row in (0..rows).filter(|_| columns > 1) {
            let factor = sine(row + 1) - sine(row);
            difference(row * columns + column, row * columns + before, across * factor);
        }
    }
    // Where the radius was raised above what the rays measured, the gradient is trusted that much less.
    let trust = (harmonic_mean(record) / record.radius).clamp(0.0, 1.0);
    all.iter_mut().for_each(|ray| ray.translation *= trust);
    all
}

/// Harmonic mean of the lengths of a record's rays; those that missed count as infinitely long.
pub(super) fn harmonic_mean(record: &IrradianceRecord) -> f32 {
    let inverse: f64 = record.rays.iter().map(|ray| 1.0 / f64::from(ray.length.max(f32::MIN_POSITIVE))).sum();
    (record.rays.len() as f64 / inverse) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use pm_formats::IrradianceRay;

    /// A record whose rays go through the middle of their strata and end where `length` says.
    fn record(normal: Vec3, strata: [u32; 2], length: impl Fn(Vec3) -> f32) -> (IrradianceRecord, Vec<Vec3>) {
        let (x, y) = frame(normal);
        let directions: Vec<Vec3> = (0..strata[0] * strata[1])
            .map(|sample| {
                let u = ((sample / strata[1]) as f32 + 0.5) / strata[0] as f32;
                let (sin, cos) = libm::sincosf(2.0 * PI * ((sample % strata[1]) as f32 + 0.5) / strata[1] as f32);
                (x * cos + y * sin) * u.sqrt() + normal * (1.0 - u).sqrt()
            })
            .collect();
        let rays = directions.iter().map(|&d| IrradianceRay { length: length(d), light: [0.0; 3] }).collect();
        let record =
            IrradianceRecord { pixel: 0, position: [0.0; 3], normal: normal.into(), radius: 1e-3, strata, rays };
        (record, directions)
    }

    fn sums(record: &IrradianceRecord, radiance: &[f32]) -> (f32, Vec3, Vec3) {
        let coefficients = coefficients(record);
        let mut sums = (0.0, Vec3::ZERO, Vec3::ZERO);
        for (ray, &radiance) in coefficients.iter().zip(radiance) {
            sums.0 += ray.irradiance * radiance;
            sums.1 += ray.rotation * radiance;
            sums.2 += ray.translation * radiance;
        }
        sums
    }

    #[test]
    fn even_light_has_no_gradient() {
        let (record, directions) = record(Vec3::Z, [10, 12], |_| 2.0);
        let (irradiance, rotation, translation) = sums(&record, &vec![1.0; directions.len()]);
        assert!((irradiance - PI).abs() < 1e-4);
        assert!(rotation.length() < 1e-4 && translation.length() < 1e-4, "{rotation} {translation}");
    }

    #[test]
    fn light_that_grows_along_a_ceiling_grows_along_the_floor() {
        // A ceiling at height h whose radiance is c + g . x: the irradiance below is pi (c + g . x), gradient pi g.
        let height = 0.7;
        for normal in [Vec3::Z, Vec3::NEG_X, Vec3::new(1.0, 2.0, -2.0) / 3.0] {
            let (along, _) = frame(normal);
            let (record, directions) = record(normal, [40, 40], |d| height / d.dot(normal));
            let radiance: Vec<f32> =
                directions.iter().map(|&d| 3.0 + (d * (height / d.dot(normal))).dot(along) * 0.5).collect();
            let (_, _, translation) = sums(&record, &radiance);
            let expected = along * (PI * 0.5);
            assert!(translation.distance(expected) < 0.08 * expected.length(), "{translation} for {expected}");
        }
    }

    #[test]
    fn light_from_one_side_grows_as_the_surface_turns_to_it() {
        // L = c + b . d gives E(n) = pi c + 2 pi / 3 b . n for every normal n.
        let (normal, b) = (Vec3::Y, Vec3::new(0.6, 0.2, -0.3));
        let (record, directions) = record(normal, [30, 30], |_| 5.0);
        let radiance: Vec<f32> = directions.iter().map(|&d| 2.0 + b.dot(d)).collect();
        let (irradiance, rotation, _) = sums(&record, &radiance);
        let known = |n: Vec3| 2.0 * PI + 2.0 * PI / 3.0 * b.dot(n);
        assert!((irradiance - known(normal)).abs() < 0.01);
        for turned in [Vec3::new(0.1, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.1), Vec3::new(-0.07, 1.0, 0.07)] {
            let turned = turned.normalize();
            let change = rotation.dot(normal.cross(turned));
            let expected = known(turned) - known(normal);
            assert!((change - expected).abs() < 0.1 * expected.abs() + 0.004, "{change} for {expected}");
        }
    }

    #[test]
    fn rays_that_miss_or_touch_do_no_harm() {
        let (record, directions) = record(Vec3::Z, [4, 4], |d| if d.x > 0.0 { f32::INFINITY } else { 0.0 });
        let (_, _, translation) = sums(&record, &vec![1.0; directions.len()]);
        assert!(translation.is_finite());
    }
}
