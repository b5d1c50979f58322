//! Does anything at all load, or give an error of one line?

use super::support::{SQUARE, load_files};
use crate::scene::{LoadOptions, MaterialKind, Scene};
use proptest::prelude::*;

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
