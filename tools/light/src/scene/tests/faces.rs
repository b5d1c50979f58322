//! Are vertices, normals and faces read as exporters write them?

use super::support::{SQUARE, error, load, strict_error};
use crate::scene::{Dropped, Scene};
use glam::Vec3;

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
        ("f 1 2 x", "\"x\" is not an index"),
        ("f 1/1/1/1 2 3", "more than three indices"),
        ("f 1.0 2 3", "index \"1.0\" is not a whole number"),
        ("f /1 2 3", "\"\" is not an index"),
    ] {
        let said = error(format!("{SQUARE}{face}\n"));
        assert!(said.starts_with("t.obj:5: f: ") && said.contains(what) && !said.contains('\n'), "{face}: {said}");
    }
}

/// Is a face shaded flat whose normal is not there, unless the reading is strict?
#[test]
fn normals_that_are_not_there() {
    let obj = format!("{SQUARE}f 1//9 2//9 3//9\nf 1//-1 3//1 4//1\n");
    let scene = load(&obj).unwrap();
    assert_eq!((scene.triangle_count(), scene.corner_normals(0)), (2, None));
    let said = "t.obj:5: f: normal 9 does not exist; 0 are defined above this line, counted from 1";
    assert_eq!(scene.warnings[0], format!("{said}: its face is shaded flat (and 5 more like this)"));
    assert_eq!(strict_error(&obj), said);
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
        ("v 1 2 3 4 5", "v with 5 numbers"),
        ("v 1 two 3", "\"two\" is not a number"),
        ("vn 1 2", "vn with 2 numbers"),
        ("vn a b c", "\"a b c\" are not three numbers"),
    ] {
        let said = error(format!("\n{vertex}\n{SQUARE}f 1 2 3"));
        assert!(said.starts_with("t.obj:2: ") && said.contains(what), "{vertex}: {said}");
    }
}

/// Are weights and colours of vertices left out, also where only some have them?
#[test]
fn vertex_weights_and_colours() {
    let scene = load("v 0 0 0 2\nv 1 0 0 2\nv 0 1 0 .1 .2 .3\nf 1 2 3\nv 1 2 3 0\n").unwrap();
    assert_eq!(scene.triangle(0), [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert!(scene.warnings[0].starts_with("t.obj:1: v has a fourth number, which is left out"), "{:?}", scene.warnings);
    assert_eq!(scene.warnings[1], "t.obj:3: colours of vertices are ignored");
}

fn area(scene: &Scene) -> f64 {
    (0..scene.triangle_count()).map(|i| scene.area(i)).sum()
}

/// Are concave polygons cut inside their outline, holes joined by a bridge left out, and outlines that cross themselves said?
#[test]
fn concave_polygons() {
    let arrow = load("v 0 0 0\nv 1 1 0\nv -1 0 0\nv 1 -1 0\nf 2 3 4 1\nf 3 4 1 2\n").unwrap();
    assert_eq!((arrow.triangle_count(), area(&arrow)), (4, 2.0));
    assert!((0..4).all(|i| arrow.geometric_normal(i) == Vec3::Z) && arrow.warnings.len() == 1);
    let comb = "v 0 0 0\nv 6 0 0\nv 6 3 0\nv 5 1 0\nv 4 3 0\nv 3 1 0\nv 2 3 0\nv 1 1 0\nv 0 3 0\n";
    let scene = load(format!("{comb}\n\nf 1 2 3 4 5 6 7 8 9\nf 9 8 7 6 5 4 3 2 1\n")).unwrap();
    assert!((area(&scene) - 24.0).abs() < 1e-6, "{}", area(&scene));
    let up = (0..scene.triangle_count()).filter(|&i| scene.geometric_normal(i) == Vec3::Z).count();
    assert_eq!(2 * up, scene.triangle_count());
    assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings); // no material
    let crossing = "v 0 1 0\nv 1 -1 0\nv -1 .3 0\nv 1 .3 0\nv -1 -1 0\nf 1 2 3 4 5\n";
    let warning = "t.obj:6: the outline of a polygon crosses itself: it is cut as well as can be";
    assert!(load(crossing).unwrap().warnings.contains(&warning.to_owned()));
}

/// Do a U, a frame whose hole is joined to its outline by a bridge, and a disc of 64,000 corners have their areas?
#[test]
fn polygons_of_one_face_have_their_areas() {
    let u = "v 0 0 0\nv 3 0 0\nv 3 0 -3\nv 2 0 -3\nv 2 0 -1\nv 1 0 -1\nv 1 0 -3\nv 0 0 -3\nf 1 2 3 4 5 6 7 8\n";
    assert!((area(&load(u).unwrap()) - 7.0).abs() < 1e-6);
    let frame = "v 0 0 0\nv 4 0 0\nv 4 0 -4\nv 0 0 -4\nv 1 0 -1\nv 1 0 -3\nv 3 0 -3\nv 3 0 -1\nf 1 2 3 4 1 5 6 7 8 5\n";
    assert!((area(&load(frame).unwrap()) - 12.0).abs() < 1e-6);
    let n = 64_000;
    let corner = |i: i32| {
        let (sin, cos) = (2.0 * std::f64::consts::PI * f64::from(i) / f64::from(n)).sin_cos();
        format!("v {cos} {sin} 0\n")
    };
    let face: String = (1..=n).map(|i| format!(" {i}")).collect();
    let begun = std::time::Instant::now();
    let disc = load((0..n).map(corner).collect::<String>() + "f" + &face).unwrap();
    assert!((area(&disc) / std::f64::consts::PI - 1.0).abs() < 1e-5, "{}", area(&disc));
    // Quadratic time was 12 s.
    assert!(begun.elapsed() < std::time::Duration::from_secs(4), "{:?}", begun.elapsed());
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
