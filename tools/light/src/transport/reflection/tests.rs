//! Do samples carry what the BRDF says, and is the BRDF that of a real surface?

use super::super::directions::tests::distributions;
use super::super::sampling::cosine_direction;
use super::*;
use crate::scene::MaterialKind;

fn glossy(exponent: f32) -> Material {
    let paint = Material::lambert("m", [0.3, 0.2, 0.0]);
    Material { kind: MaterialKind::Glossy, specular: [0.1, 0.5, 0.9], exponent, ..paint }
}

/// Directional albedo by a midpoint sum over the hemisphere.
fn albedo(reflection: &Reflection) -> Vec3 {
    let n = 800u16;
    let mut sum = glam::DVec3::ZERO;
    for i in 0..n {
        for j in 0..n {
            // Evenly in squared sine and azimuth: the cosine is in the measure, pi / n^2 each.
            let (u, v) = ((f32::from(i) + 0.5) / f32::from(n), (f32::from(j) + 0.5) / f32::from(n));
            let direction = cosine_direction(reflection.normal, u, v);
            sum += reflection.brdf(direction).as_dvec3() * std::f64::consts::PI / f64::from(n).powi(2);
        }
    }
    sum.as_vec3()
}

#[test]
fn samples_carry_what_the_integral_of_the_brdf_says() {
    let normal = Vec3::new(0.6, 0.0, -0.8);
    for (exponent, tilt) in [(1.0, 0.0), (20.0, 0.0), (20.0, 2.0), (200.0, 0.7)] {
        let known = (normal + Vec3::Y * tilt).normalize();
        let reflection = Reflection::new(&glossy(exponent), normal, known);
        let expected = albedo(&reflection);
        assert!(expected.cmple(Vec3::new(0.4, 0.7, 0.9) + 2e-3).all(), "{exponent} {tilt}: {expected}");
        if tilt == 0.0 {
            // Along the normal: diffuse + specular, by the closed form of the integral.
            assert!(expected.distance(Vec3::new(0.4, 0.7, 0.9)) < 2e-3, "{expected}");
        }
        for spread in [Spread::Cosine, Spread::Uniform] {
            let (n, mut random) = (200_000, Random::new(&[4]));
            let (mut both, mut lobe) = (Vec3::ZERO, Vec3::ZERO);
            for _ in 0..n {
                let (u, v) = (random.unit(), random.unit());
                both += reflection.sample(spread, None, u, v, &mut random).map_or(Vec3::ZERO, |(_, w)| w) / n as f32;
                lobe += reflection.sample_lobe(u, v).map_or(Vec3::ZERO, |(_, w)| w) / n as f32;
            }
            assert!(both.distance(expected) < 0.01, "{exponent} {tilt} {spread:?}: {both} for {expected}");
            let lobe = lobe + reflection.diffuse;
            assert!(lobe.distance(expected) < 0.01, "{exponent} {tilt}: {lobe} for {expected}");
        }
    }
}

#[test]
fn the_brdf_is_reciprocal() {
    let mut random = Random::new(&[6]);
    for _ in 0..100 {
        let [a, b] = [(); 2].map(|()| uniform_direction(Vec3::Y, random.unit(), random.unit()));
        let forth = Reflection::new(&glossy(9.0), Vec3::Y, a).brdf(b);
        let back = Reflection::new(&glossy(9.0), Vec3::Y, b).brdf(a);
        assert!(forth.distance(back) < 1e-4, "{forth} {back}");
    }
}

#[test]
fn a_guided_glossy_surface_reflects_what_the_integral_of_its_brdf_says() {
    let paint = glossy(20.0);
    let mut random = Random::new(&[5]);
    for guide in distributions() {
        let reflection = Reflection::new(&paint, guide.normal, guide.normal);
        let n = 60_000;
        let mut mean = glam::DVec3::ZERO;
        for _ in 0..n {
            let (u, v) = (random.unit(), random.unit());
            let sample = reflection.sample(Spread::Cosine, Some(&guide), u, v, &mut random);
            mean += sample.map_or(Vec3::ZERO, |(_, weight)| weight).as_dvec3() / f64::from(n);
        }
        // Along the normal: diffuse + specular.
        assert!((mean - glam::DVec3::new(0.4, 0.7, 0.9)).abs().max_element() < 0.012, "{mean}");
    }
}
