//! Where the description of a scene's camera comes from.

use super::choice::CameraChoice;
use super::overrides::CameraOverrides;
use super::pinhole::Camera;
use super::{embree, file, fit};
use crate::scene::{Files, Scene, SceneError};
use std::io;
use std::path::PathBuf;

impl Camera {
    /// The camera of a scene: from `NAME.camera.toml` beside the first OBJ that has one, else from Embree's `NAME.ecs`,
    /// else so placed that all of the scene is seen, or within it if it is a closed room; `overrides` win over each of them.
    ///
    /// # Errors
    ///
    /// [`SceneError::Read`] for a camera file that is there but cannot be read, [`SceneError::Camera`] for one that makes
    /// no sense, or that does not with the overrides.
    pub fn find(
        obj: &[PathBuf],
        scene: &Scene,
        overrides: &CameraOverrides,
        files: &dyn Files,
    ) -> Result<CameraChoice, SceneError> {
        if let Some((name, text)) = first(obj, "camera.toml", files)? {
            return file::parse(&text, &name, overrides);
        }
        if let Some((name, text)) = first(obj, "ecs", files)? {
            return embree::parse(&text, &name, overrides);
        }
        fit::fit(scene, overrides)
    }

    /// The camera of [`Scene::embedded`](crate::scene::Scene::embedded), 128 x 128 pixels.
    ///
    /// # Errors
    ///
    /// [`SceneError::Camera`] if it makes no sense with the overrides.
    pub fn embedded(overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
        file::parse(include_str!("../../../scenes/cornell.camera.toml"), "built-in Cornell box", overrides)
    }
}

/// Name and text of the first file with this ending beside an OBJ.
fn first(obj: &[PathBuf], ending: &str, files: &dyn Files) -> Result<Option<(String, String)>, SceneError> {
    for path in obj.iter().map(|path| path.with_extension(ending)) {
        let text = files.read(&path).and_then(|bytes| {
            String::from_utf8(bytes)
                .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "stream did not contain valid UTF-8"))
        });
        match text {
            Ok(text) => return Ok(Some((path.display().to_string(), text))),
            Err(source) if source.kind() == io::ErrorKind::NotFound => {}
            Err(source) => return Err(SceneError::Read { path, source }),
        }
    }
    Ok(None)
}
