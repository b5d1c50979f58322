#!/usr/bin/env bash
# obvhs 0.4.0: the eight-wide tree (CwBvh) does not see what lies nearer than 1e-4 of the ray's origin, in whatever unit the
# scene has; the binary tree (Bvh2) of the same crate, built of the same triangle, does.
#
# One triangle, large and straight ahead, is moved towards the eye. A caster of rays would see it at any distance above 0.
# Seen: at distance 1 and 0.001 both hit; at 0.00005 and at 0.000001 Bvh2 hits and CwBvh does not.
# So a scene in metres that is rendered with CwBvh loses contact shadows and corners nearer than 0.1 mm, one in kilometres
# those nearer than 10 cm. Needs cargo and the crates' registry; fails if the behaviour is another.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "near-hits"
version = "0.0.0"
edition = "2021"
[dependencies]
glam = "=0.34.0"
obvhs = "=0.4.0"
[workspace]
TOML
cat > "$folder/src/main.rs" <<'RUST'
use glam::Vec3A;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;
use obvhs::BvhBuildParams;
use std::time::Duration;

fn main() {
    for distance in [1.0, 1e-3, 5e-5, 1e-6f32] {
        let corner = |x: f32, y: f32| Vec3A::new(x, y, distance);
        let triangle = Triangle { v0: corner(-10.0, -10.0), v1: corner(10.0, -10.0), v2: corner(0.0, 10.0) };
        let triangles = [triangle];
        let ray = || Ray::new(Vec3A::ZERO, Vec3A::Z, 0.0, f32::MAX);
        let mut time = Duration::default();
        let binary = build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), &mut time);
        let wide = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), &mut time);
        let hits_binary = binary.ray_traverse(ray(), &mut RayHit::none(), |ray, _| triangle.intersect(ray));
        let hits_wide = wide.ray_traverse(ray(), &mut RayHit::none(), |ray, _| triangle.intersect(ray));
        println!("{distance:e}: Bvh2 {hits_binary}, CwBvh {hits_wide}");
    }
}
RUST
cd "$folder"
found=$(cargo run --quiet --release 2>errors) || { cat errors >&2; exit 1; }
expected='1e0: Bvh2 true, CwBvh true
1e-3: Bvh2 true, CwBvh true
5e-5: Bvh2 true, CwBvh false
1e-6: Bvh2 true, CwBvh false'
echo "$found"
[ "$found" = "$expected" ] || { echo "obvhs 0.4.0 behaves otherwise than was found" >&2; exit 1; }
