//! Scenes to test with: shipped ones, and small ones written for the purpose.

use crate::scene::{Camera, CameraOverrides, FileSystem, LoadOptions, Scene};
use std::path::{Path, PathBuf};

pub(in crate::transport) fn shipped(name: &str) -> (Scene, PathBuf) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    (Scene::load(std::slice::from_ref(&path), &LoadOptions::default(), &FileSystem).unwrap(), path)
}

pub(in crate::transport) fn written(obj: &str, mtl: &str) -> Scene {
    written_with(obj, mtl, &LoadOptions::default())
}

pub(in crate::transport) fn written_with(obj: &str, mtl: &str, options: &LoadOptions) -> Scene {
    let obj = format!("mtllib t.mtl\n{obj}");
    let files = |path: &Path| match path.to_str() {
        Some("t.obj") => Ok(obj.clone().into_bytes()),
        Some("t.mtl") => Ok(mtl.as_bytes().to_vec()),
        _ => Err(std::io::ErrorKind::NotFound.into()),
    };
    Scene::load(&["t.obj".into()], options, &files).unwrap()
}

/// A box from `min` to `max` of one material, its faces turned outward or inward.
pub(in crate::transport) fn cuboid(first_vertex: usize, min: f32, max: f32, material: &str, outward: bool) -> String {
    let mut text = String::new();
    for i in 0..8 {
        let side = |bit: usize| if i >> bit & 1 == 1 { max } else { min };
        text += &format!("v {} {} {}\n", side(0), side(1), side(2));
    }
    text += &format!("usemtl {material}\n");
    for face in [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]] {
        let mut face = face.map(|i| first_vertex + i);
        if !outward {
            face.reverse();
        }
        text += &format!("f {} {} {} {}\n", face[0], face[1], face[2], face[3]);
    }
    text
}

pub(in crate::transport) fn camera(path: &Path) -> Camera {
    let (scene, overrides) = (Scene::load(&[path.to_owned()], &LoadOptions::default(), &FileSystem).unwrap(), [24, 20]);
    let overrides = CameraOverrides { size: Some(overrides), ..CameraOverrides::default() };
    Camera::find(&[path.to_owned()], &scene, &overrides, &FileSystem).unwrap().camera
}
