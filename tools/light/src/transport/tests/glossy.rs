//! Do glossy surfaces send on what they should?

use super::super::{GatherOptions, PathPhoton, Spread};
use super::photons::{assert_within_errors, incident};
use super::pictures::{OPTIONS, rays_with, total};
use super::scenes::{cuboid, written_with};
use crate::scene::{Camera, CameraOverrides, FileSystem, LoadOptions};
use glam::DVec3;
use std::path::PathBuf;

#[test]
fn a_glossy_body_in_a_furnace_neither_makes_nor_swallows_light() {
    // Kd + Ks = 1. A lobe so sharp loses some 0.6 / sqrt(n) of diffuse light: 0.04 % of what there is in the room.
    let mtl = "newmtl wall\nKd 0.2 0.5 0.8\nKe 1 1 1\nillum 1\n\
               newmtl paint\nKd 0.4 0.4 0.4\nKs 0.6 0.6 0.6\nNs 30000\nillum 2\n";
    let obj = cuboid(1, -1.0, 1.0, "wall", false) + &cuboid(9, -0.4, 0.4, "paint", true);
    let scene = written_with(&obj, mtl, &LoadOptions { glossy: true, ..LoadOptions::default() });
    assert!(scene.materials.iter().any(|material| material.specular == [0.6; 3] && material.exponent == 30000.0));
    let on_wall = |photon: &PathPhoton| usize::from(photon.position.abs().max_element() < 0.999);
    let found = incident(&scene, 100_000, on_wall, 2);
    // The walls catch what they emit and each other's reflections, wherever the body sends them.
    assert_within_errors(found[0], [1.25, 2.0, 5.0], "glossy");
    // And the body sees as much as anything of its area: flux = area ratio x that of the walls (both convex).
    assert_within_errors(found[1], [0.16 * 1.25, 0.16 * 2.0, 0.16 * 5.0], "body");
}

#[test]
fn gather_rays_of_glossy_points_carry_the_albedo() {
    // A wall of paint seen from inside a closed cube: along the normal the weights add up to Kd + Ks.
    let mtl = "newmtl paint\nKd 0.2 0.3 0.1\nKs 0.4 0.2 0.6\nNs 40\nillum 2\nnewmtl lamp\nKe 1 1 1\n";
    let obj = cuboid(1, -1.0, 1.0, "paint", false) + &cuboid(9, 2.0, 2.1, "lamp", true);
    let scene = written_with(&obj, mtl, &LoadOptions { glossy: true, ..LoadOptions::default() });
    let view = CameraOverrides {
        eye: Some([0.0, 0.0, 0.5]),
        look_at: Some([0.0, 0.0, -1.0]),
        vfov: Some(2.0),
        size: Some([24, 20]),
        ..CameraOverrides::default()
    };
    let camera = Camera::find(&[PathBuf::from("none.obj")], &scene, &view, &FileSystem).unwrap().camera;
    for spread in [Spread::Cosine, Spread::Uniform] {
        let options = GatherOptions { gathers: 100, spread, ..OPTIONS };
        let found = total(&rays_with(&scene, camera, options).0) / (24.0 * 20.0);
        // The second surfaces are glossy too: queries, as on the first.
        let expected = DVec3::new(0.6, 0.5, 0.7);
        assert!((found - expected).abs().max_element() < 0.005, "{spread:?}: {found}");
    }
}
