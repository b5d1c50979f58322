//! The Cornell box with rough walls: light and spheres as they are, floor, ceiling and sides displaced by a fractal.
//!
//! Heights are sums of octaves of random lattices, each interpolated linearly, of twice the frequency and a fixed share
//! of the amplitude of the one before: midpoint displacement by successive random additions (Voss, in *The Science of
//! Fractal Images*, 1988, chapter 1), which can be asked for anywhere, so that the cut into triangles is free.

use super::grid::{lines_through, surface};
use super::model::Model;
use super::recipe::{Recipe, at_least};
use crate::scene::Scene;
use glam::{DVec3, Vec3};
use pm_random::Random;
use pm_registry::registered;

registered! {
    /// The Cornell box with both spheres and fractal walls
    pub struct Fractal = "fractal" with [at_least("200000")];
}

/// Seed of the heights.
const SEED: u64 = 2005;
/// Height of the coarsest octave at most, m.
const AMPLITUDE: f64 = 0.03;
/// Amplitude of each octave over that of the one before: fractal dimension 2.2.
const GAIN: f64 = 0.574;
const OCTAVES: u32 = 10;

/// Half the sides of the light, m, about the middle of the ceiling.
const LIGHT: [f64; 2] = [0.125, 0.09375];
/// Around the light the ceiling rises to its full height within this, m.
const LIGHT_MARGIN: f64 = 0.1;
/// Middles of the spheres, and their radius, m.
const SPHERES: [DVec3; 2] = [DVec3::new(-0.21, 0.176, -0.2), DVec3::new(0.21, 0.176, 0.16)];
const SPHERE_RADIUS: f64 = 0.175;

impl Recipe for Fractal {
    /// The box has about `fineness` cells along each edge.
    fn build(&self, fineness: u32) -> Model {
        let cells = fineness as usize;
        let mut model = Model::new(
            include_str!("../../scenes/cornell.mtl").split_once("\n\n").expect("a head and materials").1,
            include_str!("../../scenes/cornell.camera.toml"),
        );
        model.about = vec![
            "The Cornell box with a mirror and a glass sphere, its walls displaced inward by fractals of up to".into(),
            "7 cm. Light, spheres, colours and camera are those of cornell. Metres, y up, open towards +z.".into(),
        ];
        // Walls share the lines along their common edges, so that these have no cracks.
        let xs = lines_through(&[-0.5, -LIGHT[0], LIGHT[0], 0.5], cells);
        let ys = lines_through(&[0.0, 1.0], cells);
        let zs = lines_through(&[-0.5, -LIGHT[1], LIGHT[1], 0.5], cells);
        let (nx, ny, nz) = (xs.len() - 1, ys.len() - 1, zs.len() - 1);
        let all = |_: usize, _: usize| true;

        model.group("floor", "white");
        surface(&mut model, nz, nx, |k, i| DVec3::new(xs[i], floor_height(xs[i], zs[k]), zs[k]), all);
        model.group("ceiling", "white");
        let in_light = |x: f64, z: f64| x.abs() < LIGHT[0] && z.abs() < LIGHT[1];
        let ceiling = |i: usize, k: usize| DVec3::new(xs[i], 1.0 - ceiling_depth(xs[i], zs[k]), zs[k]);
        let open = |i: usize, k: usize| in_light((xs[i] + xs[i + 1]) / 2.0, (zs[k] + zs[k + 1]) / 2.0);
        surface(&mut model, nx, nz, ceiling, |i, k| !open(i, k));
        model.group("back", "white");
        let back = |i: usize, j: usize| DVec3::new(xs[i], ys[j], -0.5 + height(3, xs[i] + 0.5, ys[j]));
        surface(&mut model, nx, ny, back, all);
        model.group("left", "red");
        let left = |j: usize, k: usize| DVec3::new(-0.5 + height(4, ys[j], zs[k] + 0.5), ys[j], zs[k]);
        surface(&mut model, ny, nz, left, all);
        model.group("right", "green");
        let right = |k: usize, j: usize| DVec3::new(0.5 - height(5, ys[j], zs[k] + 0.5), ys[j], zs[k]);
        surface(&mut model, nz, ny, right, all);

        for name in ["light", "mirror", "glass"] {
            copy(&mut model, name);
        }
        model
    }
}

/// The floor rises nowhere more than half-way to a sphere above it.
fn floor_height(x: f64, z: f64) -> f64 {
    let room = SPHERES.iter().map(|middle| {
        let square = SPHERE_RADIUS * SPHERE_RADIUS - (x - middle.x) * (x - middle.x) - (z - middle.z) * (z - middle.z);
        if square > 0.0 { (middle.y - square.sqrt()) / 2.0 } else { f64::INFINITY }
    });
    room.fold(height(1, x + 0.5, z + 0.5), f64::min)
}

/// The ceiling comes down nowhere at the light, and gently around it.
fn ceiling_depth(x: f64, z: f64) -> f64 {
    let (beyond_x, beyond_z) = ((x.abs() - LIGHT[0]).max(0.0), (z.abs() - LIGHT[1]).max(0.0));
    let share = ((beyond_x * beyond_x + beyond_z * beyond_z).sqrt() / LIGHT_MARGIN).min(1.0);
    height(2, x + 0.5, z + 0.5) * share
}

/// Height of wall number `wall` at (u, v) of the unit square, m: at least 0, and 0 at its border.
fn height(wall: u64, u: f64, v: f64) -> f64 {
    let (mut sum, mut amplitude) = (0.0, AMPLITUDE);
    for octave in 1..=OCTAVES {
        let across = 1u32 << octave;
        let lattice = |i: u32, j: u32| {
            if i == 0 || j == 0 || i >= across || j >= across {
                return 0.0;
            }
            f64::from(Random::new(&[SEED, wall, u64::from(octave), u64::from(i), u64::from(j)]).unit())
        };
        let (x, y) = (u * f64::from(across), v * f64::from(across));
        let (i, j) = (x.floor() as u32, y.floor() as u32);
        let (s, t) = (x - f64::from(i), y - f64::from(j));
        let row = |j: u32| lattice(i, j) * (1.0 - s) + lattice(i + 1, j) * s;
        sum += amplitude * (row(j) * (1.0 - t) + row(j + 1) * t);
        amplitude *= GAIN;
    }
    sum
}

/// Takes all triangles of a material from the built-in Cornell box.
fn copy(model: &mut Model, material: &'static str) {
    let cornell = Scene::embedded();
    model.group(material, material);
    for i in (0..cornell.triangle_count()).filter(|&i| cornell.material_of(i).name == material) {
        let mut numbers =
            |points: [Vec3; 3], add: fn(&mut Model, DVec3) -> u32| points.map(|p| add(model, p.as_dvec3()));
        let corners = numbers(cornell.triangle(i), Model::point);
        match cornell.corner_normals(i).map(|normals| numbers(normals, Model::normal)) {
            Some(normals) => model.smooth_triangle(corners, normals),
            None => model.triangle(corners),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Is the border of every wall exactly flat, so that walls meet without cracks, and the inside never outside?
    #[test]
    fn heights_are_zero_at_borders_and_positive_inside() {
        for wall in 1..=5 {
            let mut highest = 0f64;
            for i in 0..=300 {
                let t = f64::from(i) / 300.0;
                assert_eq!(
                    [height(wall, 0.0, t), height(wall, t, 0.0), height(wall, 1.0, t), height(wall, t, 1.0)],
                    [0.0; 4]
                );
                let inside = height(wall, t, 1.0 - t);
                assert!((0.0..AMPLITUDE / (1.0 - GAIN)).contains(&inside));
                highest = highest.max(inside);
            }
            assert!(highest > 0.01, "wall {wall} is flat: {highest}");
        }
    }

    /// Does no wall touch a sphere or hang into the light? (A sphere that sinks into the floor leaks light.)
    #[test]
    fn walls_keep_clear_of_spheres_and_light() {
        let walls = Fractal.build(142);
        let cornell = Scene::embedded();
        for part in ["o floor", "o ceiling", "o back", "o left", "o right"] {
            assert!(walls.obj("t").contains(part), "{part}");
        }
        for i in 0..=400 {
            for k in 0..=400 {
                let (x, z) = (f64::from(i) / 400.0 - 0.5, f64::from(k) / 400.0 - 0.5);
                let floor = DVec3::new(x, floor_height(x, z), z);
                assert!(SPHERES.iter().all(|middle| floor.distance(*middle) > SPHERE_RADIUS + 4e-4), "{floor}");
                if x.abs() <= LIGHT[0] && z.abs() <= LIGHT[1] {
                    assert_eq!(ceiling_depth(x, z), 0.0);
                }
            }
        }
        assert!(cornell.triangle_count() > 0);
    }
}
