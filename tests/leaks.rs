//! Does a sealed dark room stay dark beside a lit one, whatever the method?

use crate::support::Folder;
use pm_gathering::{Edges, Estimator, Kernel};
use pm_pictures::{Picture, Region, RegionMean};
use pm_registry::Choice;
use std::fmt::Write as _;

/// Two rooms that share floor, ceiling, front and back, with a wall between them so thick (m); if 0 it is a single sheet. The
/// lamp is in the left one.
fn two_rooms(folder: &Folder, thickness: f64) {
    let (x, y, z, w, lamp) = (1.0, 1.0, 0.5, thickness / 2.0, 0.15);
    let around = |cx: f64, y: f64| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[a, b]| [cx + a * lamp, y, b * lamp])
    };
    let mut quads = vec![
        ("wall", [[-x, 0.0, z], [x, 0.0, z], [x, 0.0, -z], [-x, 0.0, -z]]),
        ("wall", [[-x, y, -z], [x, y, -z], [x, y, z], [-x, y, z]]),
        ("wall", [[-x, 0.0, -z], [x, 0.0, -z], [x, y, -z], [-x, y, -z]]),
        ("wall", [[x, 0.0, z], [-x, 0.0, z], [-x, y, z], [x, y, z]]),
        ("wall", [[-x, 0.0, z], [-x, 0.0, -z], [-x, y, -z], [-x, y, z]]),
        ("wall", [[x, 0.0, -z], [x, 0.0, z], [x, y, z], [x, y, -z]]),
        ("wall", [[-w, 0.0, -z], [-w, 0.0, z], [-w, y, z], [-w, y, -z]]),
        ("lamp", around(-0.5, 0.99)),
    ];
    if w > 0.0 {
        quads.push(("wall", [[w, 0.0, z], [w, 0.0, -z], [w, y, -z], [w, y, z]]));
    }
    let mut obj = "mtllib two-rooms.mtl\n".to_owned();
    for (material, corners) in quads {
        corners.iter().for_each(|[x, y, z]| writeln!(obj, "v {x} {y} {z}").unwrap());
        writeln!(obj, "usemtl {material}\nf -4 -3 -2 -1").unwrap();
    }
    folder.write("two-rooms.obj", obj);
    folder.write("two-rooms.mtl", "newmtl wall\nKd 0.6 0.6 0.6\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n");
}

const SIZE: &str = "--vfov 70 --size 12x12";

fn mean(folder: &Folder, name: &str) -> f64 {
    let picture = Picture::decode_exr(&folder.read(name)).unwrap();
    RegionMean::new(&picture, Region::All).unwrap().mean[1]
}

/// Radiance of the lit room that this is a share of, W/(m² sr).
fn lit(folder: &Folder) -> f64 {
    let view = format!("--eye -0.95,0.5,0 --look-at 0,0.4,0 {SIZE}");
    folder.run(&format!("pm-queries -q two-rooms.obj {view} --gathers 9 --base b.exr -o q.pmq")).ok();
    folder.run("pm-gather map.pmp q.pmq --base b.exr --image lit.exr --no-trace").ok();
    mean(folder, "lit.exr")
}

/// An option with each of its words.
fn words<T: Choice>(option: &str) -> impl Iterator<Item = String> {
    T::ALL.iter().map(move |named| format!("--{option} {}", named.word))
}

#[test]
fn no_method_lights_a_sealed_room() {
    // Catches: sites of the lit room that answer queries of the dark one; photons behind a wall that count.
    let dark = format!("--eye 0.95,0.5,0 --look-at 0,0.4,0 {SIZE}");
    for thickness in [0.02, 0.0] {
        let folder = Folder::new();
        two_rooms(&folder, thickness);
        folder.run("pm-photons -q two-rooms.obj -n 50000 -o map.pmp").ok();
        let lit = lit(&folder);
        assert!((0.2..0.3).contains(&lit), "{lit}");
        for queries in [
            "--gathers 9",
            "--gathers 9 --guide map.pmp",
            "--gathers 16 --irradiance-cache 0.2",
            "--direct-visualisation",
        ] {
            let base = if queries.starts_with("--direct") { "" } else { "--base b.exr" };
            folder.run(&format!("pm-queries -q two-rooms.obj {dark} {queries} {base} -o q.pmq")).ok();
            // However wide a cell may be, and however few photons there are in it.
            let held = pm_gathering::irradiance_structures().words().into_iter();
            let held =
                held.flat_map(|map| ["", "--footprint 0.02", "--footprint 9"].map(|how| format!("--map {map} {how}")));
            let mut ways: Vec<&str> = held.map(|way| &*way.leak()).collect();
            ways.extend(["", "--precomputed", "--precomputed --precomputed-share 1", "-k 10 --precomputed"]);
            ways.extend(["--photon-radii", "-k 10 --photon-radii", "--photon-radii --edges ignored"]);
            if queries == "--gathers 9" {
                let maps = pm_maps::structures().words();
                let maps = maps.iter().flat_map(|map| [format!("--map {map}"), format!("--map {map} --precomputed")]);
                ways.extend(maps.map(|way| &*way.leak()));
                let options =
                    words::<Edges>("edges").chain(words::<Kernel>("kernel")).chain(words::<Estimator>("estimator"));
                let options = options.flat_map(|way| [format!("{way} --precomputed"), format!("{way} -k 10"), way]);
                ways.extend(options.map(|way| &*way.leak()));
            }
            for way in ways {
                folder.run(&format!("pm-gather -q map.pmp q.pmq {way} {base} --image x.exr --no-trace")).ok();
                let found = mean(&folder, "x.exr");
                assert!(found < 1e-3 * lit, "wall of {thickness} m, {queries}, {way}: {found} where {lit} is lit");
            }
        }
    }
}
