//! Does a scene as a whole load, or say why it cannot?

use super::support::{LAMP, SQUARE, error, load, load_files};
use crate::scene::{FileSystem, LoadOptions, Scene, SceneError};
use glam::Vec3;
use std::path::{Path, PathBuf};

/// Does each hopeless scene say in one line what is missing and what to do?
#[test]
fn hopeless_scenes_say_why() {
    let said = |paths: &[&str]| {
        let paths: Vec<PathBuf> = paths.iter().map(PathBuf::from).collect();
        Scene::load(&paths, &LoadOptions::default(), &FileSystem).unwrap_err().to_string()
    };
    assert_eq!(said(&["gone.obj"]), "gone.obj: no such file; check the name, or give the path of an OBJ file");
    assert!(said(&[]).starts_with("no OBJ file given: no faces"));
    assert!(error("").starts_with("t.obj: no faces"));
    let dark = load_files(&[("t.obj", format!("{SQUARE}f 1 2 3").as_bytes())], &LoadOptions::default()).unwrap_err();
    assert_eq!(dark.to_string(), "t.obj: nothing emits light; give a material `Ke`, or add a light by --quad-light");
}

/// Are files of other kinds named, and is what to do about them said?
#[test]
fn files_of_other_kinds_are_named() {
    let said =
        |name: &str, bytes: &[u8]| load_files(&[(name, bytes)], &LoadOptions::default()).unwrap_err().to_string();
    let what = "which is not read; convert it to OBJ (and check Ke: converters lose the strength of lamps)";
    assert_eq!(said("room.glb", b"glTF\x02\0\0\0"), format!("room.glb: glTF, {what}"));
    assert_eq!(said("room.obj", b"glTF\x02\0\0\0"), format!("room.obj: glTF, {what}"));
    assert_eq!(said("Room.GLTF", b"{}"), format!("Room.GLTF: glTF, {what}"));
    assert!(said("r.usdz", b"PK\x03\x04").contains(": USD, "));
    assert!(said("r.obj", b"#usda 1.0\n").contains(": USD, "));
    assert!(said("r.blend", b"BLENDER-v405").contains("a Blender file"));
}

/// Is what was passed over named where nothing emits light?
#[test]
fn lamps_that_are_passed_over_are_named() {
    let obj = format!("mtllib m.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\n");
    let mtl = "newmtl a\nKd 1\nKe 0 0 0\nmap_Ke glow.png\nnewmtl b\nke 5 5 5\n";
    let dark =
        load_files(&[("t.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes())], &LoadOptions::default()).unwrap_err();
    assert_eq!(
        dark.to_string(),
        "t.obj: nothing emits light (passed over: `map_Ke` in m.mtl:4; `ke` in m.mtl:6, which is not `Ke`); give a material \
         `Ke`, or add a light by --quad-light"
    );
}

/// Is a library named that is not there, where nothing emits light?
#[test]
fn libraries_that_are_not_there_are_named_where_nothing_emits() {
    let obj = format!("mtllib gone.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\n");
    let dark = load_files(&[("t.obj", obj.as_bytes())], &LoadOptions::default()).unwrap_err().to_string();
    let said = "t.obj: nothing emits light (passed over: t.obj:1: material library \"gone.mtl\": no such file; ";
    assert!(dark.starts_with(said) && dark.ends_with("give a material `Ke`, or add a light by --quad-light"), "{dark}");
}

/// Is a lamp without an area no lamp?
#[test]
fn lamp_without_area_is_no_light() {
    let obj = format!("mtllib m.mtl\n{SQUARE}usemtl lamp\nf 1 1 2\nusemtl paint\nf 1 2 3\n");
    let dark = load_files(&[("t.obj", obj.as_bytes()), ("m.mtl", LAMP.as_bytes())], &LoadOptions::default());
    assert!(
        matches!(&dark, Err(SceneError::NoLight { lost, .. }) if lost.contains("\"lamp\", which would, have no area")),
        "{dark:?}"
    );
    let scene = load(obj).unwrap();
    assert_eq!((scene.materials.len(), scene.lights().len(), scene.material_of(0).name.as_str()), (1, 0, "paint"));
}

/// Do merged files keep their own materials, even of the same name?
#[test]
fn files_are_merged() {
    let read = |path: &Path| {
        let text = match path.to_str().unwrap() {
            "a.obj" => format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3 4\n"),
            "b.obj" => format!("mtllib b.mtl\n{SQUARE}usemtl m\nf 1 2 3\n"),
            "a.mtl" => "newmtl m\nKd .1\n".into(),
            _ => "newmtl m\nKe 5\n".into(),
        };
        Ok(text.into_bytes())
    };
    let scene = Scene::load(&["a.obj".into(), "b.obj".into()], &LoadOptions::default(), &read).unwrap();
    assert_eq!((scene.triangle_count(), scene.materials.len()), (3, 2));
    assert_eq!((scene.material_of(1).diffuse, scene.material_of(2).emission), ([0.1; 3], [5.0; 3]));
    assert_eq!(scene.triangle(2)[1], Vec3::X);
}

/// Does a scene load the same at any scale and far from the origin?
#[test]
fn scale_and_offset() {
    for (scale, offset) in [(1e-6, 0.0), (1.0, 8192.0), (1e6, 0.0), (1e-6, 1e-3)] {
        let vertex = |x: f64, y: f64| format!("v {} {} {offset}\n", x * scale + offset, y * scale + offset);
        let square = [vertex(0., 0.), vertex(1., 0.), vertex(1., 1.), vertex(0., 1.)].concat();
        let scene = load(format!("mtllib m.mtl\n{square}usemtl lamp\nf 1 2 3 4\n")).unwrap();
        assert_eq!(
            (scene.triangle_count(), scene.dropped.total(), scene.lights().len()),
            (2, 0, 2),
            "{scale} {offset}"
        );
        assert_eq!(scene.geometric_normal(0), Vec3::Z);
        let flux = std::f64::consts::PI * scale * scale;
        assert!((scene.emitted_flux()[0] / flux - 1.0).abs() < 1e-3, "{scale} {offset}");
        assert_eq!(f64::from(scene.bounds.min.x), f64::from(offset as f32));
    }
}

/// Is the table aligned, and does it tell kind, colours, counts and areas?
#[test]
fn material_table() {
    let table = Scene::embedded().material_table();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "material  kind       reflects        emits    triangles      area");
    assert_eq!(lines[2], "red       diffuse    0.64 0.06 0.05  -                2    1.0000");
    assert_eq!(lines[4], "light     light      0               18 14 7          2  4.688e-2");
    assert_eq!(lines[6].split_whitespace().collect::<Vec<_>>()[..5], ["glass", "glass", "1.5", "transmits", "1"]);
    assert!(lines.iter().all(|line| line.len() == lines[0].len()));
}
