//! Scenes: OBJ, and the materials that it names.

use pm_light::scene::{LoadOptions, Scene};
use std::io;
use std::path::{Path, PathBuf};

/// What stands before the first byte 0 is the OBJ file, what stands behind it any other.
pub(super) fn load(data: &[u8]) {
    let at = data.iter().position(|&byte| byte == 0).unwrap_or(data.len());
    let (object, rest) = (&data[..at], data.get(at + 1..).unwrap_or_default());
    let files = |path: &Path| -> io::Result<Vec<u8>> {
        match path.extension().is_some_and(|ending| ending == "obj") {
            true => Ok(object.to_vec()),
            false => Ok(rest.to_vec()),
        }
    };
    for allow_dark in [false, true] {
        let options = LoadOptions { glossy: true, allow_dark, ..LoadOptions::default() };
        let _ = Scene::load(&[PathBuf::from("a.obj")], &options, &files);
    }
}
