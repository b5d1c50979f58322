//! `NAME.camera.toml`: `eye`, `look_at`, `up`, `vfov`, `size`.

use serde::Deserialize;

use super::choice::{CameraChoice, choose};
use super::overrides::CameraOverrides;
use super::pinhole::{SIZE, UP, VFOV, View};
use crate::scene::SceneError;

/// The file; what it does not say is as in [`pinhole`](super::pinhole).
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraFile {
    eye: [f64; 3],
    look_at: [f64; 3],
    #[serde(default = "up")]
    up: [f64; 3],
    #[serde(default = "vfov")]
    vfov: f64,
    #[serde(default = "size")]
    size: [u32; 2],
}

fn up() -> [f64; 3] {
    UP
}

fn vfov() -> f64 {
    VFOV
}

fn size() -> [u32; 2] {
    SIZE
}

/// Reads a camera file that came from `whence`.
pub(super) fn parse(text: &str, whence: &str, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let CameraFile { eye, look_at, up, vfov, size } = toml::from_str(text).map_err(|error| {
        let line = error.span().map_or(1, |span| 1 + text[..span.start.min(text.len())].matches('\n').count());
        let what = error.message().replace('\n', ", ");
        SceneError::Camera { whence: format!("{whence}:{line}"), what }
    })?;
    choose(View { eye, look_at, up, vfov, size }, whence, overrides)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn error(text: &str) -> String {
        parse(text, "a.camera.toml", &CameraOverrides::default()).unwrap_err().to_string()
    }

    /// Are whole numbers read as well, and does the command line win?
    #[test]
    fn file_then_overrides() {
        let text = "eye = [0, 0.5, 2]\nlook_at = [0, 0.5, 0]\nvfov = 40\nsize = [64, 32]\n";
        let overrides = CameraOverrides { vfov: Some(50.0), ..Default::default() };
        let choice = parse(text, "a.camera.toml", &overrides).unwrap();
        assert_eq!((choice.camera.vfov(), choice.camera.size()), (50.0, [64, 32]));
        assert_eq!((choice.camera.eye(), choice.camera.up()), (Vec3::new(0.0, 0.5, 2.0), Vec3::Y));
        assert_eq!(choice.note, "camera: a.camera.toml; vfov by option");
    }

    /// Is a misspelt or missing key named with its line, in one line?
    #[test]
    fn unknown_and_missing_keys_are_named() {
        let unknown = error("eye = [0, 0, 1]\nlook_at = [0, 0, 0]\nfov = 40\n");
        assert!(
            unknown.starts_with("camera (a.camera.toml:3): unknown field `fov`, expected one of `eye`"),
            "{unknown}"
        );
        assert!(error("eye = [0, 0, 1]").contains("missing field `look_at`"));
        for bad in ["eye = [0, 0]", "eye = \"0 0 1\"", "eye = ", "size = [-1, 2]", "\u{0}"] {
            assert!(!error(bad).contains('\n'), "{bad}");
        }
    }
}
