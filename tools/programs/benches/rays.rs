//! How fast are rays, as ratios to the better of the library's two hierarchies?
//!
//! The yardstick is obvhs with its own triangle test: gather rays from the points that a picture sees, as far as the first
//! triangle. Beside it stand our hierarchy on the very same rays, and all that `pm-queries` does for a ray of that picture: random
//! numbers, mirrors and glass, queries, their stream, as it goes into a pipe and, compressed, into a file. That is told of a ray
//! twice: of gather rays and eye rays alone, and of all that are cast, behind mirrors and glass as well. Rounds are interleaved and medians compared, so that a busy machine slows
//! all alike. Both have to find the same. Left out of that are rays from where two walls meet: those begin in the very plane of the
//! next wall, and by our test meet it at once, as rounding has it; not by the library's, nor in double precision.
//!
//! `cargo bench -p pm-programs --bench rays [-- WIDTH [ROUNDS [GATHERS]]]`.
#![allow(clippy::print_stdout)]

#[expect(dead_code, reason = "rooms of points are for the other benches")]
mod common;

use common::{cpu_time, median};
use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::bvh2::{Bvh2, builder::build_bvh2_from_tris};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;
use pm_formats::{BlockMeta, Bounds, Compression, Header, Query, RecordWriter};
use pm_light::scene::{Camera, CameraOverrides, Scene};
use pm_light::transport::{
    AtSpecular, Bvh, GatherOptions, GatherRays, Method, PixelCaster, RayCaster as _, RayCounts, Spread, Strata,
    Surfaces,
};
use pm_orders::VisiblePoints;
use pm_random::Random;
use std::hint::black_box;
use std::time::Duration;

/// What is met nearer than this is the plane that a ray began in. A wall is one unit long.
const AT_ONCE: f32 = 1e-6;

fn main() {
    let numbers: Vec<u32> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let number = |at: usize, default: u32| numbers.get(at).copied().unwrap_or(default);
    let (width, rounds, gathers) = (number(0, 128), number(1, 7), number(2, 16));
    let scene = Scene::embedded();
    let size = CameraOverrides { size: Some([width, width]), ..CameraOverrides::default() };
    let camera = Camera::embedded(&size).expect("a camera of this size").camera;
    let rays = gather_rays(&scene, &camera, gathers);
    let (bvh2, cwbvh, own) = (Binary::new(&scene), EightWide::new(&scene), Bvh::build(&scene));
    let picture = Picture::new(&scene, camera, gathers);
    let own = |&(origin, direction): &(Vec3, Vec3)| own.closest(origin, direction, f32::INFINITY).map(|hit| hit.t);
    let (at_once, further): (Vec<_>, Vec<_>) = rays.iter().partition(|ray| own(ray).is_some_and(|t| t < AT_ONCE));
    let other = further.iter().filter(|ray| !agree(bvh2.closest(ray), own(ray))).count();
    assert!(other * 100_000 < rays.len(), "{other} of {} rays meet something else", rays.len());

    println!(
        "{} gather rays in {} triangles, {} of them met at once; time of a ray",
        rays.len(),
        scene.triangle_count(),
        at_once.len()
    );
    let sum = |closest: &dyn Fn(&(Vec3, Vec3)) -> Option<f32>| {
        black_box(rays.iter().filter_map(closest).map(f64::from).sum::<f64>());
        [rays.len() as u64; 2]
    };
    let contestants: [Contestant<'_>; 5] = [
        ("obvhs, binary", Box::new(|| sum(&|ray| bvh2.closest(ray)))),
        ("obvhs, eight-wide", Box::new(|| sum(&|ray| cwbvh.closest(ray)))),
        ("ours", Box::new(|| sum(&own))),
        ("a picture's, into a pipe", Box::new(|| picture.write(Compression::None))),
        ("a picture's, into a file", Box::new(|| picture.write(Compression::Zstd))),
    ];
    let mut times = vec![vec![]; contestants.len()];
    // How many rays there are for each of those that are counted at first.
    let mut all = vec![1.0; contestants.len()];
    for _ in 0..rounds {
        for (((_, contestant), times), all) in contestants.iter().zip(&mut times).zip(&mut all) {
            let start = cpu_time();
            let [rays, cast] = contestant();
            times.push((cpu_time() - start).as_secs_f64() / rays as f64);
            *all = cast as f64 / rays as f64;
        }
    }
    let ratios = |times: &[f64], best: &[f64]| median(times.iter().zip(best).map(|(time, best)| time / best).collect());
    let best = usize::from(median(times[1].clone()) < median(times[0].clone()));
    for (((name, _), these), all) in contestants.iter().zip(&times).zip(all) {
        let (time, ratio) = (median(these.clone()) * 1e9, ratios(these, &times[best]));
        println!("  {name:30} {time:6.0} ns  {ratio:5.2}   of all cast {:6.0} ns  {:5.2}", time / all, ratio / all);
    }
}

/// A name, and a job that says how many rays it cast: without those behind mirrors and glass, and with them.
type Contestant<'a> = (&'a str, Box<dyn Fn() -> [u64; 2] + 'a>);

fn agree(a: Option<f32>, b: Option<f32>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-4 * (1.0 + b),
        _ => a.is_none() && b.is_none(),
    }
}

/// Rays spread by the cosine from each of the points seen.
fn gather_rays(scene: &Scene, camera: &Camera, gathers: u32) -> Vec<(Vec3, Vec3)> {
    let surfaces = Surfaces::new(scene);
    let mut random = Random::new(&[1]);
    let [width, height] = camera.size();
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (f64::from(x) + 0.5, f64::from(y) + 0.5)));
    let seen = pixels.map(|(x, y)| camera.ray(x, y)).filter_map(|(eye, direction)| surfaces.hit(eye, direction));
    let from = |point| (0..gathers).map(move |_| point);
    let towards = seen.flat_map(from).map(|point| {
        let (z, turn) = (2.0 * random.unit() - 1.0, std::f32::consts::TAU * random.unit());
        let r = (1.0 - z * z).sqrt();
        // A point of the unit sphere that touches the surface.
        let direction = (point.facing + Vec3::new(r * turn.cos(), r * turn.sin(), z)).normalize_or(point.facing);
        (point.start(direction), direction)
    });
    towards.collect()
}

fn triangles(scene: &Scene) -> Vec<Triangle> {
    let triangle = |[v0, v1, v2]: [Vec3; 3]| Triangle { v0: v0.into(), v1: v1.into(), v2: v2.into() };
    (0..scene.triangle_count()).map(|i| triangle(scene.triangle(i))).collect()
}

fn in_order(triangles: &[Triangle], order: &[u32]) -> Vec<RtTriangle> {
    order.iter().map(|&i| (&triangles[i as usize]).into()).collect()
}

/// A ray that meets nothing at its very origin, as where that lies on the plane of the next wall.
fn ray(origin: Vec3, direction: Vec3) -> Ray {
    Ray::new(origin.into(), direction.into(), f32::MIN_POSITIVE, f32::INFINITY)
}

struct Binary(Bvh2, Vec<RtTriangle>);

impl Binary {
    fn new(scene: &Scene) -> Self {
        let triangles = triangles(scene);
        let tree = build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
        let triangles = in_order(&triangles, &tree.primitive_indices);
        Self(tree, triangles)
    }

    fn closest(&self, &(origin, direction): &(Vec3, Vec3)) -> Option<f32> {
        let (ray, mut hit) = (ray(origin, direction), RayHit::none());
        self.0.ray_traverse(ray, &mut hit, |ray, place| self.1[place].intersect(ray)).then_some(hit.t)
    }
}

struct EightWide(CwBvh, Vec<RtTriangle>);

impl EightWide {
    fn new(scene: &Scene) -> Self {
        let triangles = triangles(scene);
        let tree = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
        let triangles = in_order(&triangles, &tree.primitive_indices);
        Self(tree, triangles)
    }

    fn closest(&self, &(origin, direction): &(Vec3, Vec3)) -> Option<f32> {
        let (ray, mut hit) = (ray(origin, direction), RayHit::none());
        self.0.ray_traverse(ray, &mut hit, |ray, place| self.1[place].intersect(ray)).then_some(hit.t)
    }
}

/// All of a picture's rays, as `pm-queries` casts them on one thread.
struct Picture<'a> {
    rays: GatherRays<'a>,
    header: Header,
    size: [u32; 2],
}

impl<'a> Picture<'a> {
    fn new(scene: &'a Scene, camera: Camera, gathers: u32) -> Self {
        let size = camera.size();
        let options = GatherOptions {
            method: Method::FinalGather,
            samples: 1,
            gathers,
            spread: Spread::Cosine,
            min_gather_dist: 0.0,
            light_samples: 0,
            seed: 0,
            direct: false,
            strata: Strata::Raster,
            at_specular: AtSpecular::GoOn,
            queue_specular: false,
            caustics: true,
        };
        let bounds = Bounds { min: scene.bounds.min.into(), max: scene.bounds.max.into() };
        let header = Header { bounds, image: size, ..Header::empty() };
        Self { rays: GatherRays::new(scene, camera, options), header, size }
    }

    /// Writes the queries to nowhere; returns the number of rays, eye rays included, and of those with what gather rays became
    /// behind mirrors and glass.
    fn write(&self, compression: Compression) -> [u64; 2] {
        let mut counts = RayCounts::default();
        let mut writer = RecordWriter::<Query, _>::new(std::io::sink(), &self.header).expect("a header");
        writer = writer.with_compression(compression);
        let mut queries = vec![];
        for y in 0..self.size[1] {
            let mut caster = PixelCaster::new(&self.rays, None);
            for x in 0..self.size[0] {
                caster.pixel([x, y], VisiblePoints::All, |query| queries.push(query), |_| {}, &mut counts);
            }
            writer.write(BlockMeta::default(), &queries).expect("what is written to nowhere");
            queries.clear();
        }
        writer.finish(vec![]).expect("what is written to nowhere");
        let rays = counts.gather + counts.eye;
        [rays, rays + counts.gather_further]
    }
}
