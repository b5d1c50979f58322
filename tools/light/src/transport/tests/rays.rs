//! Do rays hit what they should?

use super::super::{Bvh, RayCaster, Surfaces};
use super::scenes::shipped;
use crate::scene::Scene;
use glam::Vec3;
use pm_random::Random;

/// The first triangle by looking at all, in double precision: Möller and Trumbore, an independent method.
fn closest_by_brute_force(scene: &Scene, origin: Vec3, direction: Vec3) -> Option<f64> {
    let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
    let hit = |i: usize| {
        let [a, b, c] = scene.triangle(i).map(|p| p.as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let p = d.cross(ac);
        let determinant = ab.dot(p);
        let (s, q) = (o - a, (o - a).cross(ab));
        let (u, v, t) = (s.dot(p) / determinant, d.dot(q) / determinant, ac.dot(q) / determinant);
        (determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
    };
    (0..scene.triangle_count()).filter_map(hit).min_by(f64::total_cmp)
}

fn direction(random: &mut Random) -> Vec3 {
    let mut coordinate = || random.unit() * 2.0 - 1.0;
    Vec3::new(coordinate(), coordinate(), coordinate()).normalize_or(Vec3::X)
}

#[test]
fn rays_hit_what_looking_at_every_triangle_finds() {
    let (scene, _) = shipped("cornell.obj");
    let bvh = Bvh::build(&scene);
    let mut random = Random::new(&[11]);
    let mut hits = 0;
    for i in 0..20_000 {
        let origin = Vec3::new(random.unit() - 0.5, random.unit(), random.unit() - 0.5);
        let direction = match i % 4 {
            // Along the axes, with zeros of both signs: slabs of width 0 and divisions by 0.
            0 => [Vec3::X, Vec3::NEG_Y, Vec3::new(-0.0, 0.0, 1.0), Vec3::new(0.0, -1.0, -0.0)][i / 4 % 4],
            _ => direction(&mut random),
        };
        let expected = closest_by_brute_force(&scene, origin, direction);
        let found = bvh.closest(origin, direction, f32::INFINITY).map(|hit| f64::from(hit.t));
        match (found, expected) {
            (Some(found), Some(expected)) => {
                assert!((found - expected).abs() < 1e-5 * (1.0 + expected), "{origin} {direction}: {found} {expected}");
                hits += 1;
            }
            (None, None) => {}
            // Single and double precision may differ on which side of an outline a ray passes.
            other => {
                let nudged = direction + Vec3::new(1e-6, -1e-6, 1e-6);
                assert_ne!(
                    closest_by_brute_force(&scene, origin, nudged).is_some(),
                    expected.is_some(),
                    "{origin} {direction}: {other:?}"
                );
            }
        }
    }
    assert!(hits > 15_000);
}

#[test]
fn no_ray_slips_through_an_edge() {
    // From the middle of a closed cube every ray must hit: straight at corners, edges, and the diagonals of the faces.
    let (scene, _) = shipped("furnace.obj");
    let bvh = Bvh::build(&scene);
    let middle = Vec3::new(0.0, 0.5, 0.0);
    let n = 60i16;
    for i in -n..=n {
        for j in -n..=n {
            let (a, b) = (f32::from(i) / f32::from(n), f32::from(j) / f32::from(n));
            for target in [Vec3::new(1.0, a, b), Vec3::new(a, -1.0, b), Vec3::new(a, b, -1.0), Vec3::new(-1.0, b, a)] {
                assert!(bvh.closest(middle, target.normalize(), f32::INFINITY).is_some(), "{target}");
                assert!(bvh.blocked(middle, middle + target * 2.0), "{target}");
                assert!(!bvh.blocked(middle, middle + target * 0.49), "{target}");
            }
        }
    }
}

#[test]
fn hits_on_a_wall_lie_exactly_on_it_and_rays_from_it_leave_it() {
    let (scene, _) = shipped("furnace.obj");
    let surfaces = Surfaces::new(&scene);
    let mut random = Random::new(&[5]);
    for _ in 0..20_000 {
        let origin = Vec3::new(random.unit() - 0.5, random.unit(), random.unit() - 0.5) * 0.999 + Vec3::Y * 0.0005;
        let point = surfaces.hit(origin, direction(&mut random)).unwrap();
        let p = point.position;
        let on_wall = p.x.abs() == 0.5 || p.z.abs() == 0.5 || p.y == 0.0 || p.y == 1.0;
        assert!(on_wall, "{p}");
        // Back into the room, at any angle: never the wall itself, which would be at no distance.
        let mut onward = direction(&mut random);
        if onward.dot(point.facing) < 0.0 {
            onward = -onward;
        }
        let next = surfaces.hit(point.start(onward), onward).expect("the room is closed");
        assert!(next.position.distance(p) > 1e-6 || onward.dot(point.facing) < 1e-4, "{p} {onward}");
    }
}
