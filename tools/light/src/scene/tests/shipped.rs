//! Are the shipped scenes right?

use super::support::{edges, is_closed, shipped};
use crate::scene::{Camera, CameraOverrides, MaterialKind, Scene};
use glam::{DVec3, Vec3};

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
