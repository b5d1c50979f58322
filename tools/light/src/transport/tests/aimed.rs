//! Do aimed paths bring the same light to caustics, and more often?

use super::super::{PathPhoton, PhotonPaths};
use super::photons::incident_by;
use super::scenes::{shipped, written};
use crate::scene::Scene;

/// Compares the flux of caustics by aimed paths with that by all paths, and says how many photons of caustics each has.
fn compare(scene: &Scene, class: impl Fn(&PathPhoton) -> usize, classes: usize) -> [u32; 2] {
    const PATHS: u64 = 200_000;
    let mut counts = [0; 2];
    let [plain, aimed] = [0, 1].map(|aimed| {
        let paths = if aimed == 1 { PhotonPaths::of_caustics(scene, 1) } else { PhotonPaths::new(scene, 1) };
        for path in 0..20_000 {
            paths.trace(path, |photon| counts[aimed] += u32::from(photon.caustic));
        }
        // The last class holds what is no caustic.
        let class = |photon: &PathPhoton| if photon.caustic { class(photon) } else { classes };
        incident_by(&paths, scene, PATHS, class, classes + 1)
    });
    for number in 0..classes {
        for channel in 0..3 {
            let [(plain, plain_error), (aimed, error)] = [plain[number][channel], aimed[number][channel]];
            let off = (plain - aimed).abs();
            assert!(
                off < 4.0 * plain_error.hypot(error) + 1e-6,
                "{number} {channel}: {plain} +- {plain_error}, {aimed} +- {error}"
            );
            // Twice as sure at least, where there is much: half of the paths are not aimed.
            assert!(error < plain_error / 1.4 || plain < 1e-3, "{number} {channel}: +- {plain_error}, +- {error}");
        }
    }
    assert_eq!(aimed[classes][0].0, 0.0, "others than caustics");
    counts
}

#[test]
fn aimed_paths_bring_the_light_of_all_paths() {
    // Catches: power that does not make up for chance, of lamp or direction; a pilot whose numbers are used again; paths
    // that end too soon or too late.
    let (scene, _) = shipped("cornell.obj");
    let wall = |photon: &PathPhoton| {
        let p = photon.position;
        [p.y == 0.0, p.z == -0.5, p.x == -0.5, p.x == 0.5].iter().position(|&on| on).unwrap_or(4)
    };
    let [plain, aimed] = compare(&scene, wall, 5);
    assert!(aimed > 4 * plain, "{plain} and {aimed}");
}

#[test]
fn the_lamp_before_the_mirror_is_chosen_more_often() {
    // Two lamps, of which a bright one shines away from the tilted mirror.
    let quad = |at: [f32; 2], y: f32, half: f32, down: bool| {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0f32]];
        let corner = |[a, b]: [f32; 2]| format!("v {} {y} {}\n", at[0] + half * a, at[1] + half * b);
        let face = if down { "f -4 -3 -2 -1\n" } else { "f -1 -2 -3 -4\n" };
        corners.map(corner).concat() + face
    };
    let obj = format!(
        "usemtl floor\n{}usemtl dim\n{}usemtl bright\n{}v .3 .2 .5\nv .3 .2 -.5\nv .6 .8 0\nusemtl mirror\nf -3 -2 -1\n",
        quad([0.0, 0.0], 0.0, 1.0, false),
        quad([0.0, 0.0], 1.0, 0.1, true),
        quad([0.0, 0.0], 1.5, 0.1, false),
    );
    let mtl = "newmtl floor\nKd .5 .5 .5\nnewmtl dim\nKd 0 0 0\nKe 1 2 1\nnewmtl bright\nKd 0 0 0\nKe 9 9 9\n\
               newmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 3\n";
    let [plain, aimed] = compare(&written(&obj, mtl), |_| 0, 1);
    assert!(aimed > 5 * plain && plain > 0, "{plain} and {aimed}");
}

#[test]
fn where_nothing_is_focused_no_photon_is_one_of_a_caustic() {
    let (scene, _) = shipped("cornell-diffuse.obj");
    let paths = PhotonPaths::of_caustics(&scene, 1);
    (0..2000).for_each(|path| paths.trace(path, |photon| panic!("{photon:?}")));
}
