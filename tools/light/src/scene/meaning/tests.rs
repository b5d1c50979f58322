//! Is each combination of statements the surface that its writer meant?

use super::super::mtl;
use super::*;
use std::path::Path;

/// What a material of these statements becomes, and what is said about it.
fn decide_with(options: &LoadOptions, text: &str) -> (Material, Vec<String>) {
    let mut warnings = Warnings::default();
    let clean = mtl::clean(Path::new("m.mtl"), format!("newmtl m\n{text}").as_bytes(), &mut warnings).unwrap();
    let (materials, _) = tobj::load_mtl_buf(&mut clean.text.as_bytes()).unwrap();
    let texture = materials[0].diffuse_texture.as_ref().map(|_| Err("no file".to_owned()));
    let material = super::decide(&materials[0], options, texture, &clean.places["m"], &mut warnings);
    (material, warnings.into_lines())
}

fn decide(text: &str) -> (Material, Vec<String>) {
    decide_with(&LoadOptions::default(), text)
}

fn kind(text: &str) -> MaterialKind {
    decide(text).0.kind
}

/// Is a material with `Ke` a light that reflects by `Kd`, whatever else it says?
#[test]
fn ke_makes_a_light() {
    let (m, said) = decide("Kd .5 .5 .5\nKe 18 14 7\nillum 7\nNi 1.5");
    assert_eq!((m.kind, m.emission, m.diffuse), (MaterialKind::Diffuse, [18.0, 14.0, 7.0], [0.5; 3]));
    assert!(said.is_empty());
    assert_eq!(decide("Ke 1").0.diffuse, [0.0; 3]);
    let (m, said) = decide("Ke 2e6\nKd 2 1 0");
    assert_eq!((m.emission, m.diffuse), ([2e6; 3], [1.0, 0.5, 0.0]));
    assert_eq!(said.len(), 2);
    assert!(!decide("Kd 1\nKe 0 0 0").0.emits());
}

/// Is said of a lamp what it does not do: reflect without `Kd`, and mirror?
#[test]
fn lamps_are_told_what_they_do_not_do() {
    assert_eq!(decide("Ke 1").1, ["m.mtl:1: material \"m\" emits and has no Kd: it reflects nothing"]);
    let (_, said) = decide("Kd .5\nKs .5\nKe 1\nillum 2");
    assert_eq!(said, ["m.mtl:1: material \"m\" emits: what it mirrors by Ks is left out"]);
    assert!(decide("Kd .5\nKs .5\nKe 1\nillum 1").1.is_empty());
}

/// Is said what looks like glass that an exporter flattened, and of nothing else?
#[test]
fn flattened_glass_is_said() {
    // assimp-utils 5.2.5; bpy 5.0.1 with transmission, as a mirror.
    for (text, sign) in [
        ("Kd 0 0 0\nKs 1 1 1\nTf .9 .9 .9\nNi 1.5\nillum 1", "Ni 1.5 and Tf below 1 like glass, but is diffuse"),
        ("Kd .8\nKs 1\nTf .5\nNi 1.5\nillum 3", "Tf below 1 like glass, but is mirror"),
        ("Kd 0 0 0\nKs 0\nNi 1.5\nillum 2", "Ni 1.5 and a black Kd like glass"),
    ] {
        let (_, said) = decide(text);
        assert!(said.iter().any(|said| said.contains(sign)), "{text}: {said:?}");
    }
    for paint in ["Kd .8\nNi 1.45\nillum 2", "Kd 0\nNi 1\nillum 2", "Kd .1\nNi 1.5\nTf 1 1 1\nillum 4"] {
        assert!(decide(paint).1.is_empty(), "{paint}");
    }
    assert!(decide("Kd 0\nKs .9\nNi 1.5\nillum 5").1.is_empty(), "chrome");
}

/// Is glass what refracts *and* is see-through, and nothing less?
#[test]
fn glass_needs_an_index_and_transparency() {
    for glass in [
        "illum 7\nNi 1.5",
        "illum 6\nNi 1.33",
        "illum 4\nNi 1.5\nd 0.2",
        "illum 9\nNi 1.5\nTr 0.8",
        "illum 4\nNi 1.5\nTf .9",
    ] {
        assert_eq!(kind(&format!("Kd 0.1\n{glass}")), MaterialKind::Glass, "{glass}");
    }
    // Maya's plain paint; Blender's and 3ds Max's; Maya's with an index; no refraction; no index.
    for paint in
        ["illum 4\nNi 1.00\nTf 1 1 1", "illum 2\nNi 1.45\nd 1", "illum 4\nNi 1.5\nTf 1 1 1", "illum 7\nNi 1", "illum 7"]
    {
        assert_eq!(kind(&format!("Kd 0.1\n{paint}")), MaterialKind::Diffuse, "{paint}");
    }
    let (m, _) = decide("illum 7\nNi 1.5\nKs .3\nKd .2");
    assert_eq!((m.ior, m.transmittance, m.specular, m.diffuse), (1.5, [1.0; 3], [1.0; 3], [0.0; 3]));
}

/// Is a dark filter obeyed and named, and set aside by the clear-glass option?
#[test]
fn dark_glass_is_obeyed_and_said() {
    let mcguire = "illum 7\nNi 2.5\nKs 0.3 0.3 0.3\nTf 0.1 0.1 0.1";
    let (m, said) = decide(mcguire);
    assert_eq!(m.transmittance, [0.1; 3]);
    assert!(said[0].contains("transmits only 10 %"), "{said:?}");
    let (m, said) = decide_with(&LoadOptions { clear_glass: true, ..Default::default() }, mcguire);
    assert_eq!((m.transmittance, said.len()), ([1.0; 3], 0));
    assert_eq!(decide("illum 7\nNi 1.5\nTf 2 1 1").0.transmittance, [1.0, 0.5, 0.5]);
}

/// Is transparency without refraction opaque, with a word about it?
#[test]
fn thin_transparency_is_opaque_with_a_warning() {
    for thin in ["d 0.3", "Tr 0.7", "illum 7\nd 0.3\nNi 1", "illum 2\nNi 1.5\nd 0.3"] {
        let (m, said) = decide(&format!("Kd 0.1\n{thin}"));
        assert_eq!(m.kind, MaterialKind::Diffuse, "{thin}");
        assert!(said.len() == 1 && said[0].contains("opaque"), "{thin}: {said:?}");
    }
    assert!(decide("Kd 0.1\nd 1\nTr 1").1.is_empty(), "d wins over Tr");
}

/// Does a mirror reflect `Ks`, keep `Kd` as a rest that fits, and drop one that does not?
#[test]
fn mirror_reflects_ks_and_what_fits_of_kd() {
    let (m, said) = decide("illum 5\nKd 0.01\nKs 0.95\nNi 1.5");
    assert_eq!((m.kind, m.specular, m.diffuse), (MaterialKind::Mirror, [0.95; 3], [0.01; 3]));
    assert!(said.is_empty());
    let (m, said) = decide("illum 3\nKd 0.4\nKs 0.8");
    assert_eq!((m.kind, m.specular, m.diffuse, said.len()), (MaterialKind::Mirror, [0.8; 3], [0.0; 3], 1));
    assert_eq!(kind("illum 3\nKd 0.4\nKs 0"), MaterialKind::Diffuse);
}

/// Is Blender's metal tinted by `Kd`?
#[test]
fn blender_metal_is_tinted_by_kd() {
    let (m, said) = decide("Kd 0.9 0.7 0.3\nKs 0.5 0.5 0.5\nNs 250\nNi 1.45\nd 1\nillum 3");
    assert_eq!((m.kind, m.specular, m.diffuse), (MaterialKind::Mirror, [0.9, 0.7, 0.3], [0.0; 3]));
    assert!(said.is_empty());
}

/// Do `Pm` and `Pr` make mirrors and rough metals, and half-metals paint?
#[test]
fn metallic_exports() {
    let (m, _) = decide("Kd 0.9 0.7 0.3\nPm 1\nPr 0.01\nillum 3\nKs 0.5");
    assert_eq!((m.kind, m.specular, m.diffuse), (MaterialKind::Mirror, [0.9, 0.7, 0.3], [0.0; 3]));
    let (m, _) = decide("Kd 0.9\nPm 1\nPr 0.5");
    assert_eq!((m.kind, m.exponent), (MaterialKind::Glossy, 30.0));
    assert_eq!(kind("Kd 0.9\nPm 0.5\nPr 0.5\nillum 3\nKs .5"), MaterialKind::Diffuse);
}

/// Is Blender's default paint Lambert by default, and within 100 % with the glossy option?
#[test]
fn highlights_only_on_request_and_never_above_one() {
    let blender = "Kd 0.8 0.4 0.2\nKs 0.5 0.5 0.5\nNs 250\nNi 1.45\nd 1\nillum 2";
    let (m, said) = decide(blender);
    assert_eq!((m.kind, m.diffuse, m.specular, said.len()), (MaterialKind::Diffuse, [0.8, 0.4, 0.2], [0.0; 3], 0));
    let glossy = LoadOptions { glossy: true, ..Default::default() };
    let (m, said) = decide_with(&glossy, blender);
    assert_eq!((m.kind, m.exponent, said.len()), (MaterialKind::Glossy, 250.0, 1));
    assert!((0..3).all(|c| m.diffuse[c] + m.specular[c] <= 1.0));
    assert!((m.diffuse[0] + m.specular[0] - 1.0).abs() < 1e-6 && (m.diffuse[0] / m.diffuse[1] - 2.0).abs() < 1e-6);
    assert_eq!(decide_with(&glossy, "Kd .5\nKs .5\nNs 9\nillum 1").0.kind, MaterialKind::Diffuse);
}

/// Does a texture fall back on `Kd`, and on grey where Maya wrote 0?
#[test]
fn textures_fall_back_on_kd_or_grey() {
    let (m, said) = decide("Kd .2 .3 .4\nmap_Kd -s 1 1 1 c:\\a b.png");
    assert_eq!((m.diffuse, said.len()), ([0.2, 0.3, 0.4], 1));
    assert!(said[0].contains("Kd alone counts"));
    let (m, said) = decide("Kd 0 0 0\nmap_Kd a.png");
    assert_eq!((m.diffuse, said.len()), (GREY, 1));
    assert_eq!(decide("Kd 0 0 0").0.diffuse, [0.0; 3]);
    assert_eq!(decide("Ni 1").0.diffuse, GREY);
}

/// Can paint reflect more than it gets?
#[test]
fn bright_paint_is_scaled() {
    let (m, said) = decide("Kd 2 1 0.5");
    assert_eq!((m.diffuse, said.len()), ([1.0, 0.5, 0.25], 1));
}
