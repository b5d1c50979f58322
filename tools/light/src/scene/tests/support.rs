//! Small scenes and what can be asked of them.

use crate::scene::{Camera, CameraOverrides, FileSystem, LoadOptions, Material, Scene, SceneError};
use std::collections::HashMap;
use std::io;
use std::path::Path;

pub(super) const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

pub(super) const LAMP: &str = "newmtl lamp\nKd 0\nKe 1\nnewmtl paint\nKd .5\n";

/// Loads the first of some files given as (name, text).
pub(super) fn load_files(files: &[(&str, &[u8])], options: &LoadOptions) -> Result<Scene, SceneError> {
    let read = |path: &Path| {
        let found = files.iter().find(|(name, _)| Path::new(name) == path);
        found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into())
    };
    Scene::load(&[files[0].0.into()], options, &read)
}

/// Loads an OBJ beside a library `m.mtl` of a lamp and a paint; light is not asked for.
pub(super) fn load(obj: impl AsRef<[u8]>) -> Result<Scene, SceneError> {
    let options = LoadOptions { allow_dark: true, ..Default::default() };
    load_files(&[("t.obj", obj.as_ref()), ("m.mtl", LAMP.as_bytes())], &options)
}

pub(super) fn error(obj: impl AsRef<[u8]>) -> String {
    load(obj).unwrap_err().to_string()
}

pub(super) fn shipped(name: &str) -> (Scene, Camera) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    let scene = Scene::load(std::slice::from_ref(&path), &LoadOptions::default(), &FileSystem).unwrap();
    let camera = Camera::find(&[path], &scene, &CameraOverrides::default(), &FileSystem).unwrap();
    assert!(!camera.fitted && camera.warnings.is_empty());
    (scene, camera.camera)
}

/// Triangles that use each edge in each direction, by position.
pub(super) fn edges(scene: &Scene, of: impl Fn(&Material) -> bool) -> HashMap<[[u32; 3]; 2], usize> {
    let mut out = HashMap::new();
    for i in (0..scene.triangle_count()).filter(|&i| of(scene.material_of(i))) {
        let corners = scene.triangle(i).map(|p| (p + 0.0).to_array().map(f32::to_bits));
        for c in 0..3 {
            *out.entry([corners[c], corners[(c + 1) % 3]]).or_default() += 1;
        }
    }
    out
}

pub(super) fn is_closed(edges: &HashMap<[[u32; 3]; 2], usize>) -> bool {
    edges.iter().all(|(&[a, b], &count)| count == 1 && edges.get(&[b, a]) == Some(&1))
}

/// What a strict reading says.
pub(super) fn strict_error(obj: impl AsRef<[u8]>) -> String {
    let options = LoadOptions { allow_dark: true, strict: true, ..Default::default() };
    load_files(&[("t.obj", obj.as_ref()), ("m.mtl", LAMP.as_bytes())], &options).unwrap_err().to_string()
}
