//! Scenes as a whole: does what users bring load, does what cannot work say why, and are the shipped scenes right?

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::*;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const LAMP: &str = "newmtl lamp\nKe 1\nnewmtl paint\nKd .5\n";

/// Loads the first of some files given as (name, text).
fn load_files(files: &[(&str, &[u8])], options: &LoadOptions) -> Result<Scene, SceneError> {
    let read = |path: &Path| {
        let found = files.iter().find(|(name, _)| Path::new(name) == path);
        found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into())
    };
    Scene::load_with(&[files[0].0.into()], options, &read)
}

/// Loads an OBJ beside a library `m.mtl` of a lamp and a paint; light is not asked for.
fn load(obj: impl AsRef<[u8]>) -> Result<Scene, SceneError> {
    let options = LoadOptions { allow_dark: true, ..Default::default() };
    load_files(&[("t.obj", obj.as_ref()), ("m.mtl", LAMP.as_bytes())], &options)
}

fn error(obj: impl AsRef<[u8]>) -> String {
    load(obj).unwrap_err().to_string()
}

fn shipped(name: &str) -> (Scene, Camera) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    let scene = Scene::load(std::slice::from_ref(&path), &LoadOptions::default()).unwrap();
    let camera = Camera::find(&[path], &scene.bounds, &CameraOverrides::default()).unwrap();
    assert!(!camera.fitted && camera.warnings.is_empty());
    (scene, camera.camera)
}

/// Triangles that use each edge in each direction, by position.
fn edges(scene: &Scene, of: impl Fn(&Material) -> bool) -> HashMap<[[u32; 3]; 2], usize> {
    let mut out = HashMap::new();
    for i in (0..scene.triangle_count()).filter(|&i| of(scene.material_of(i))) {
        let corners = scene.triangle(i).map(|p| (p + 0.0).to_array().map(f32::to_bits));
        for c in 0..3 {
            *out.entry([corners[c], corners[(c + 1) % 3]]).or_default() += 1;
        }
    }
    out
}

fn is_closed(edges: &HashMap<[[u32; 3]; 2], usize>) -> bool {
    edges.iter().all(|(&[a, b], &count)| count == 1 && edges.get(&[b, a]) == Some(&1))
}

// What exporters write.

/// Does a byte-order mark before `mtllib` lose the materials?
#[test]
fn byte_order_mark() {
    let obj = format!("\u{feff}mtllib m.mtl\n{SQUARE}usemtl lamp\nf 1 2 3 4\n");
    assert!(load(obj).unwrap().material_of(0).emits());
}

/// Are `mtllib` lists and names with spaces told apart, and paths with backslashes found?
#[test]
fn library_lists_and_names_with_spaces() {
    let obj = |lib: &str| format!("mtllib {lib}\n{SQUARE}usemtl lamp\nf 1 2 3\nusemtl other\nf 1 3 4\n");
    let other: &[u8] = b"newmtl other\nKd 1 0 0\n";
    let both = [LAMP.as_bytes(), other].concat();
    let red = |scene: Scene| assert_eq!(scene.material_of(1).diffuse, [1.0, 0.0, 0.0]);
    let options = LoadOptions::default();
    red(load_files(
        &[("t.obj", obj("a.mtl b.mtl").as_bytes()), ("a.mtl", LAMP.as_bytes()), ("b.mtl", other)],
        &options,
    )
    .unwrap());
    red(load_files(&[("t.obj", obj("a b.mtl").as_bytes()), ("a b.mtl", &both)], &options).unwrap());
    red(load_files(&[("d/t.obj", obj("lib\\a.mtl").as_bytes()), ("d/lib/a.mtl", &both)], &options).unwrap());
    let missing = load_files(&[("t.obj", obj("a.mtl b.mtl").as_bytes()), ("a.mtl", &both)], &options).unwrap_err();
    assert!(
        missing.to_string().starts_with("t.obj:1: material library \"b.mtl\": no such file; put it beside"),
        "{missing}"
    );
}

/// Does a `usemtl` above its `mtllib`, or split by a tab, find its material?
#[test]
fn library_after_use_and_tabs() {
    let scene = load(format!("{SQUARE}usemtl\tlamp\nf 1 2 3 4\nmtllib\tm.mtl\nmtllib m.mtl\n")).unwrap();
    assert!(scene.material_of(0).emits());
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

/// Is a missing library an error, and an unknown material grey with a warning?
#[test]
fn missing_library_and_unknown_material() {
    let missing = error(format!("# x\nmtllib gone.mtl\n{SQUARE}f 1 2 3\n"));
    assert_eq!(
        missing,
        "t.obj:2: material library \"gone.mtl\": no such file; put it beside the OBJ or correct the mtllib line"
    );
    let scene =
        load(format!("mtllib m.mtl\n{SQUARE}usemtl lamp\nf 1 2 3\nusemtl nope\nf 1 3 4\nusemtl nope\n")).unwrap();
    assert_eq!(scene.material_of(1).diffuse, [0.5; 3]);
    assert!(!scene.material_of(1).emits(), "the material before must not go on");
    assert_eq!(
        scene.warnings[0],
        "t.obj:8: material \"nope\" is in no library; grey 0.5 takes its place (and 1 more like this)"
    );
}

/// Do one-number colours, spectra and bad numbers in a library keep to their own line?
#[test]
fn library_traps() {
    let obj = format!("mtllib m.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\n");
    let with = |mtl: &str| load_files(&[("t.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes())], &LoadOptions::default());
    let scene = with("newmtl a\nKd 0.5\nKe 1\nKs spectral file.rfl\n").unwrap();
    assert_eq!(scene.material_of(0).diffuse, [0.5; 3]);
    assert_eq!(scene.warnings.len(), 1);
    assert_eq!(with("newmtl a\nKd 0.5 0.5 x\n").unwrap_err().to_string(), "m.mtl:2: Kd: \"x\" is not a number");
}

/// Do relative indices mean the same as absolute ones?
#[test]
fn negative_indices() {
    let scene =
        load(format!("{SQUARE}f -4 -3 -2\nv 9 9 9\nf -2//1 -5//1 -3//1\n").replace("f -2", "vn 0 0 1\nf -2")).unwrap();
    assert_eq!(scene.triangle(0), [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0)]);
    assert_eq!(scene.triangle(1), [Vec3::Y, Vec3::ZERO, Vec3::new(1.0, 1.0, 0.0)]);
}

/// Does an index that points nowhere say which, where, and of how many?
#[test]
fn bad_indices_name_their_line() {
    for (face, what) in [
        ("f 1 2 5", "vertex 5 does not exist; 4 are defined above this line"),
        ("f 0 1 2", "vertex 0 does not exist"),
        ("f -5 1 2", "vertex -5 does not exist"),
        ("f -9223372036854775808 1 2", "vertex -9223372036854775808 does not exist"),
        ("f 9223372036854775808 1 2", "index \"9223372036854775808\" is not a whole number"),
        ("f 1//1 2//1 3//1", "normal 1 does not exist; 0 are defined"),
        ("f 1 2 x", "\"x\" is not an index"),
        ("f 1/1/1/1 2 3", "more than three indices"),
        ("f 1.0 2 3", "index \"1.0\" is not a whole number"),
        ("f /1 2 3", "\"\" is not an index"),
    ] {
        let said = error(format!("{SQUARE}{face}\n"));
        assert!(said.starts_with("t.obj:5: f: ") && said.contains(what) && !said.contains('\n'), "{face}: {said}");
    }
}

/// Are vertices that are no places refused with file and line?
#[test]
fn senseless_vertices_name_their_line() {
    for (vertex, what) in [
        ("v 0 nan 0", "\"nan\" is not a number"),
        ("v inf 0 0", "\"inf\" is infinite"),
        ("v 1e39 0 0", "infinite in single precision"),
        ("v 1e19 0 0", "farther than 1e18"),
        ("v 1 2", "v with 2 numbers"),
        ("v 1 2 3 0", "farther than 1e18"),
        ("v 1 2 3 4 5", "v with 5 numbers"),
        ("v 1 two 3", "\"two\" is not a number"),
        ("vn 1 2", "vn with 2 numbers"),
        ("vn a b c", "\"a b c\" are not three numbers"),
    ] {
        let said = error(format!("\n{vertex}\n{SQUARE}f 1 2 3"));
        assert!(said.starts_with("t.obj:2: ") && said.contains(what), "{vertex}: {said}");
    }
}

/// Are weights divided out, and colours of vertices left out, also where only some have them?
#[test]
fn vertex_weights_and_colours() {
    let scene = load("v 0 0 0 2\nv 2 0 0 2\nv 0 1 0 .1 .2 .3\nf 1 2 3\n").unwrap();
    assert_eq!(scene.triangle(0), [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(scene.warnings[0], "t.obj:3: colours of vertices are ignored");
}

/// Is a quadrangle with a dent cut inside its outline, and a polygon that cannot be fanned reported?
#[test]
fn concave_polygons() {
    let area = |scene: &Scene| (0..scene.triangle_count()).map(|i| scene.area(i)).sum::<f64>();
    let arrow = load("v 0 0 0\nv 1 1 0\nv -1 0 0\nv 1 -1 0\nf 2 3 4 1\nf 3 4 1 2\n").unwrap();
    assert_eq!((arrow.triangle_count(), area(&arrow)), (4, 2.0));
    assert!((0..4).all(|i| arrow.geometric_normal(i) == Vec3::Z) && arrow.warnings.len() == 1);
    let comb = "v 0 0 0\nv 6 0 0\nv 6 3 0\nv 5 1 0\nv 4 3 0\nv 3 1 0\nv 2 3 0\nv 1 1 0\nv 0 3 0\n";
    let scene = load(format!("{comb}\n\nf 1 2 3 4 5 6 7 8 9\nf 1 2 3 4 5 6 7 8 9\n")).unwrap();
    let warning = "t.obj:12: a concave polygon is cut wrongly; triangulate it before export (and 1 more like this)";
    assert!(scene.warnings.contains(&warning.to_owned()), "{:?}", scene.warnings);
}

/// Are faces without an area dropped and counted, lines and points never made into triangles?
#[test]
fn faces_without_area_are_counted() {
    let scene = load(format!("{SQUARE}v 2 0 0\nf 1 2 3 4\nf 1 1 2\nf 1 2 5\nf 1 2\nl 1 2 3\np 1\n")).unwrap();
    assert_eq!((scene.triangle_count(), scene.dropped), (2, Dropped { repeated_corner: 1, zero_area: 1 }));
    assert!(scene.warnings.contains(&"t.obj: 2 of 4 triangles have no area and are left out".to_owned()));
    assert_eq!(error(format!("{SQUARE}f 1 1 2\n")).split(';').next(), Some("t.obj: no faces with an area"));
}

/// Where winding and `vn` disagree, does `vn` tell the side that shines?
#[test]
fn vn_wins_over_winding() {
    let upward = "mtllib m.mtl\nv 0 2 0\nv 0 2 1\nv 1 2 1\nv 1 2 0\nusemtl lamp\n";
    let lamp = load(format!("{upward}f 1 2 3 4\n")).unwrap();
    assert_eq!(lamp.geometric_normal(0), Vec3::Y);
    let lamp = load(format!("{upward}vn 0 -3 0\nf 1//1 2//1 3//1 4//1\n")).unwrap();
    assert_eq!((lamp.geometric_normal(0), lamp.geometric_normal(1)), (Vec3::NEG_Y, Vec3::NEG_Y));
    assert_eq!(lamp.corner_normals(1), Some([Vec3::NEG_Y; 3]));
    assert!(lamp.warnings[0].contains("2 triangles are wound against their vn"), "{:?}", lamp.warnings);
}

/// Do faces with and without normals, mixed and one by one, keep their own?
#[test]
fn normals_stay_with_their_corners() {
    let obj = format!(
        "{SQUARE}vn 0 0 2\nvn 1 0 1\nvn 0 0 0\nf 1//1 2//2 3//1\nf 1 3 4\nf 1//2 2//2 3//1\nf 1//1 2 3//1\nf 1//1 2//3 3//1\n"
    );
    let scene = load(obj).unwrap();
    let slanted = Vec3::new(1.0, 0.0, 1.0).normalize();
    let normals: Vec<_> = (0..5).map(|i| scene.corner_normals(i)).collect();
    assert_eq!(normals, [Some([Vec3::Z, slanted, Vec3::Z]), None, Some([slanted, slanted, Vec3::Z]), None, None]);
    assert!(scene.warnings[0].starts_with("t.obj:7: a normal without a direction"));
}

/// Are unknown statements said once, and free-form curves not taken for faces?
#[test]
fn unknown_statements() {
    let scene =
        load(format!("{SQUARE}#comment\nvt 0 0\ns off\ng a b\ncurv 0 1 1 2\ncurv 0 1 1 2\nf 1/1 2/1 3/1 # c\n"))
            .unwrap();
    assert_eq!(scene.warnings[0], "t.obj:9: curv is ignored (and 1 more like this)");
    assert_eq!(scene.warnings.len(), 2); // the other: no material
}

// What cannot work.

/// Does each hopeless scene say in one line what is missing and what to do?
#[test]
fn hopeless_scenes_say_why() {
    let said = |paths: &[&str]| {
        let paths: Vec<PathBuf> = paths.iter().map(PathBuf::from).collect();
        Scene::load(&paths, &LoadOptions::default()).unwrap_err().to_string()
    };
    assert_eq!(said(&["gone.obj"]), "gone.obj: no such file; check the name, or give the path of an OBJ file");
    assert!(said(&[]).starts_with("no OBJ file given: no faces"));
    assert!(error("").starts_with("t.obj: no faces"));
    let dark = load_files(&[("t.obj", format!("{SQUARE}f 1 2 3").as_bytes())], &LoadOptions::default()).unwrap_err();
    assert_eq!(dark.to_string(), "t.obj: nothing emits light; give a material `Ke`, or add a light by --quad-light");
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

// Several files, scale and place.

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
    let scene = Scene::load_with(&["a.obj".into(), "b.obj".into()], &LoadOptions::default(), &read).unwrap();
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

// The shipped scenes.

/// Does the light of each Cornell box shine downward with the published flux?
#[test]
fn cornell_light() {
    for name in ["cornell.obj", "cornell-diffuse.obj"] {
        let (scene, _) = shipped(name);
        let lights = scene.lights();
        assert_eq!(lights.len(), 2);
        assert!(lights.iter().all(|light| scene.geometric_normal(light.triangle as usize) == Vec3::NEG_Y));
        assert!((lights.iter().map(|light| light.area).sum::<f64>() - 0.25 * 0.1875).abs() < 1e-9);
        for (flux, published) in scene.emitted_flux().iter().zip([2.65072, 2.06167, 1.03084]) {
            assert!((flux - published).abs() < 1e-5, "{name}: {flux}");
        }
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
    }
}

/// Does every surface of the boxes face the inside, and every block and sphere outward?
#[test]
fn windings_face_where_light_is() {
    for name in ["cornell.obj", "cornell-diffuse.obj", "furnace.obj"] {
        let (scene, _) = shipped(name);
        for i in 0..scene.triangle_count() {
            let [a, b, c] = scene.triangle(i);
            let centre = (a + b + c) / 3.0;
            let on_wall = [centre.x.abs() - 0.5, centre.z.abs() - 0.5, (centre.y - 0.5).abs() - 0.5]
                .iter()
                .any(|d| d.abs() < 1e-6);
            if on_wall {
                assert!(
                    scene.geometric_normal(i).dot(Vec3::new(0.0, 0.5, 0.0) - centre) > 0.0,
                    "{name}: wall triangle {i}"
                );
            }
        }
    }
    let (blocks, _) = shipped("cornell-diffuse.obj");
    for (first, middle) in [(18, Vec3::new(-0.16, 0.3, -0.16)), (28, Vec3::new(0.18, 0.145, 0.17))] {
        for i in first..first + 10 {
            assert!(blocks.geometric_normal(i).dot(blocks.triangle(i)[0] - middle) > 0.0, "block triangle {i}");
        }
    }
}

/// Is the all-diffuse box the published one: its surfaces, colours and areas?
#[test]
fn diffuse_box_is_the_published_one() {
    let (scene, camera) = shipped("cornell-diffuse.obj");
    assert_eq!(scene.triangle_count(), 38);
    assert_eq!((scene.bounds.min, scene.bounds.max), (Vec3::new(-0.5, 0.0, -0.5), Vec3::new(0.5, 1.0, 0.5)));
    let area =
        |name: &str| -> f64 { (0..38).filter(|&i| scene.material_of(i).name == name).map(|i| scene.area(i)).sum() };
    let blocks = 0.28 * 0.28 * 2.0 + 4.0 * 0.28 * (0.6 + 0.29);
    assert!((area("white") - (3.0 - 0.25 * 0.1875 + blocks)).abs() < 1e-6);
    assert!((area("red") - 1.0).abs() < 1e-9 && (area("green") - 1.0).abs() < 1e-9);
    let colours: Vec<_> = scene.materials.iter().map(|m| (m.name.as_str(), m.diffuse)).collect();
    let expected =
        [("white", [0.74; 3]), ("red", [0.64, 0.06, 0.05]), ("green", [0.14, 0.46, 0.09]), ("light", [0.0; 3])];
    assert_eq!(colours, expected);
    assert_eq!((camera.size(), camera.vfov(), camera.eye()), ([128, 128], 39.3077, Vec3::new(0.0, 0.5, 1.94)));
}

/// Is the furnace closed, so that no light gets out?
#[test]
fn furnace_is_closed() {
    let (scene, camera) = shipped("furnace.obj");
    assert_eq!((scene.triangle_count(), scene.lights().len()), (12, 12));
    assert!(is_closed(&edges(&scene, |_| true)));
    let m = scene.material_of(0);
    assert_eq!((m.diffuse, m.emission), ([0.2, 0.5, 0.8], [1.0; 3]));
    assert!(camera.eye().cmpgt(scene.bounds.min).all() && camera.eye().cmplt(scene.bounds.max).all());
}

/// Are the spheres closed, round, smooth, outward, clear of the floor and each other, and of the right stuff?
#[test]
fn spheres_are_spheres() {
    let (scene, _) = shipped("cornell.obj");
    assert_eq!(scene.triangle_count(), 2578);
    let r = 0.175;
    for (name, kind, centre) in [
        ("mirror", MaterialKind::Mirror, DVec3::new(-0.21, 0.176, -0.2)),
        ("glass", MaterialKind::Glass, DVec3::new(0.21, 0.176, 0.16)),
    ] {
        assert!(is_closed(&edges(&scene, |m| m.name == name)), "{name}");
        let mut area = 0.0;
        for i in (0..scene.triangle_count()).filter(|&i| scene.material_of(i).name == name) {
            assert_eq!(scene.material_of(i).kind, kind);
            let normals = scene.corner_normals(i).unwrap();
            for (p, n) in scene.triangle(i).iter().zip(normals) {
                let out = (p.as_dvec3() - centre) / r;
                assert!((out.length() - 1.0).abs() < 1e-5 && (n.as_dvec3() - out).length() < 1e-5, "{name}: {p} {n}");
                assert!((n.length() - 1.0).abs() < 1e-6 && p.y > 0.0);
                assert!(scene.geometric_normal(i).dot(n) > 0.99);
            }
            area += scene.area(i);
        }
        let exact = 4.0 * std::f64::consts::PI * r * r;
        assert!(area < exact && area > 0.99 * exact, "{name}: {area}");
    }
    let glass = scene.materials.iter().find(|m| m.kind == MaterialKind::Glass).unwrap();
    assert_eq!((glass.ior, glass.transmittance), (1.5, [1.0; 3]));
}

/// Is the built-in scene the shipped one, with its camera?
#[test]
fn embedded_scene_is_the_shipped_one() {
    let (scene, camera) = shipped("cornell.obj");
    let embedded = Scene::embedded();
    assert_eq!((embedded.positions, embedded.indices), (scene.positions, scene.indices));
    assert_eq!((embedded.materials, embedded.material_ids), (scene.materials, scene.material_ids));
    assert_eq!(Camera::embedded(&CameraOverrides::default()).unwrap().camera, camera);
}

// Anything at all.

fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => (-6i32..9).prop_map(|i| i.to_string()),
        2 => (-9.0f32..9.0).prop_map(|x| x.to_string()),
        1 => "[ -~]{0,6}",
        1 => "\\PC{0,3}",
        1 => prop::sample::select(vec!["1//1", "1/1/1", "2//-1", "-1/", "//", "nan", "1e99", "\\", "#", "m.mtl", "a", "lamp", "\t", "-halo", "spectral"])
            .prop_map(String::from),
    ]
}

fn statement() -> impl Strategy<Value = String> {
    let keyword = prop::sample::select(vec![
        "v",
        "v",
        "v 1",
        "vn",
        "vn 0 0",
        "vt",
        "f",
        "f",
        "f",
        "o",
        "g",
        "s",
        "l",
        "p",
        "usemtl",
        "usemtl a",
        "mtllib m.mtl",
        "#",
        "\u{feff}",
        "newmtl",
        "newmtl a",
        "Kd",
        "Ks",
        "Ke",
        "Tf",
        "Ns",
        "Ni",
        "d",
        "Tr",
        "illum",
        "map_Kd",
        "map_Bump",
        "bump",
        "Pm",
        "Pr",
        "Pc",
        "curv",
        "",
    ]);
    (
        keyword,
        prop::collection::vec(word(), 0..6),
        prop::sample::select(vec!["\n", "\n", "\n", "\r\n", "\\\n", "\r", " "]),
    )
        .prop_map(|(keyword, words, end)| format!("{keyword} {}{end}", words.join(" ")))
}

/// What can be asked of every scene that loads.
fn is_sound(scene: &Scene) -> bool {
    let lines = scene.warnings.iter().all(|w| !w.contains('\n'));
    let triangles = (0..scene.triangle_count()).all(|i| {
        let n = scene.geometric_normal(i);
        let m = scene.material_of(i);
        let shaded = scene.corner_normals(i).is_none_or(|ns| ns.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
        let frugal =
            m.kind == MaterialKind::Glass || (0..3).all(|c| m.diffuse[c] + m.specular[c] <= 1.0 && m.diffuse[c] >= 0.0);
        (n.length() - 1.0).abs() < 1e-5 && scene.area(i) > 0.0 && shaded && frugal
    });
    lines
        && triangles
        && scene.triangle_count() > 0
        && scene.material_table().lines().count() == scene.materials.len() + 1
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Does any text at all load soundly or give an error of one line, without a panic?
    #[test]
    fn any_statements(obj in prop::collection::vec(statement(), 0..20), mtl in prop::collection::vec(statement(), 0..12), glossy: bool) {
        let obj = format!("mtllib m.mtl\n{SQUARE}vn 0 0 1\nf 1 2 3 4\n{}\nf 1 2 3\n", obj.concat());
        let mtl = format!("newmtl a\n{}", mtl.concat());
        let options = LoadOptions { glossy, allow_dark: true, ..Default::default() };
        match load_files(&[("t.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes())], &options) {
            Ok(scene) => prop_assert!(is_sound(&scene)),
            Err(error) => prop_assert!(!error.to_string().contains('\n'), "{error}"),
        }
    }

    /// And any bytes?
    #[test]
    fn any_bytes(obj: Vec<u8>, mtl: Vec<u8>) {
        let obj = [b"mtllib m.mtl\n", SQUARE.as_bytes(), b"f 1 2 3 4\n", &obj].concat();
        let options = LoadOptions { allow_dark: true, ..Default::default() };
        if let Err(error) = load_files(&[("t.obj", &obj), ("m.mtl", &mtl)], &options) {
            prop_assert!(!error.to_string().contains('\n'), "{error}");
        }
    }
}
