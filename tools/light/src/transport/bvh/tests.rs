//! Does the eight-wide hierarchy find what the binary one finds, by whatever instructions?

use super::lanes::Instructions;
use super::ray::Ray;
use super::search::Closest;
use super::{Bvh, RayCaster as _};
use crate::transport::tests::scenes::shipped;
use glam::Vec3;
use pm_random::Random;

fn rays(n: usize) -> impl Iterator<Item = Ray> {
    let mut random = Random::new(&[23]);
    (0..n).map(move |i| {
        let mut point = || Vec3::new(random.unit() - 0.5, random.unit(), random.unit() - 0.5);
        let (origin, to) = (point(), point());
        let direction = match i % 5 {
            // Along planes and axes, with zeros of both signs.
            0 => [Vec3::X, Vec3::NEG_Y, Vec3::new(-0.0, 0.0, 1.0), Vec3::new(0.6, -0.8, -0.0)][i / 5 % 4],
            _ => to - origin,
        };
        Ray { origin, direction, far: if i % 3 == 0 { 1.0 } else { f32::INFINITY } }
    })
}

#[test]
fn both_hierarchies_find_the_same_by_all_instructions() {
    for scene in ["cornell.obj", "cornell-diffuse.obj", "furnace.obj"] {
        let (scene, _) = shipped(scene);
        let mut bvh = Bvh::build(&scene);
        for instructions in Instructions::ALL.into_iter().filter(|instructions| instructions.are_there()) {
            bvh.instructions = instructions;
            for ray in rays(20_000) {
                let binary = bvh.closest_by_binary(ray);
                assert_eq!(bvh.closest(ray.origin, ray.direction, ray.far), binary, "{instructions:?}");
                let blocked = bvh.blocked(ray.origin, ray.origin + ray.direction);
                // Rounded on its way to the second point.
                let direction = ray.origin + ray.direction - ray.origin;
                let first = bvh.closest_by_binary(Ray { direction, far: 1.0, ..ray });
                assert_eq!(blocked, first.is_some_and(|hit| hit.t < 1.0), "{instructions:?}");
            }
        }
    }
}

#[test]
fn rays_cast_together_find_what_each_finds_alone() {
    for scene in ["cornell.obj", "furnace.obj"] {
        let (scene, _) = shipped(scene);
        let mut bvh = Bvh::build(&scene);
        for instructions in Instructions::ALL.into_iter().filter(|instructions| instructions.are_there()) {
            bvh.instructions = instructions;
            let rays: Vec<Ray> = rays(2000).collect();
            let mut hits = vec![None; 3];
            for rays in [&rays[..0], &rays[..1], &rays[5..13], &rays] {
                bvh.closest_each(rays, &mut hits);
                assert_eq!(hits, rays.iter().map(|&ray| bvh.closest_by_binary(ray)).collect::<Vec<_>>());
            }
        }
    }
}

#[test]
fn of_triangles_at_the_same_distance_the_binary_hierarchy_says_which_is_first() {
    // Straight at the edges and diagonals of a cube.
    let (scene, _) = shipped("furnace.obj");
    let bvh = Bvh::build(&scene);
    let n = 40i16;
    let mut tied = 0;
    for (i, j) in
        (-n..=n).flat_map(|i| (-n..=n).map(move |j| (f32::from(i) / f32::from(n), f32::from(j) / f32::from(n))))
    {
        for direction in [Vec3::new(1.0, i, j), Vec3::new(i, -1.0, j), Vec3::new(i, j, -1.0), Vec3::new(-1.0, j, i)] {
            let ray = Ray { origin: Vec3::new(0.0, 0.5, 0.0), direction, far: f32::INFINITY };
            assert_eq!(bvh.closest(ray.origin, direction, ray.far), bvh.closest_by_binary(ray), "{direction}");
            tied += u32::from(bvh.instructions.run(Closest(&bvh.wide, ray)).is_some_and(|first| first.tied));
        }
    }
    assert!(tied > 500, "{tied}");
}
