//! A camera, and how it was come by.

use super::overrides::CameraOverrides;
use super::pinhole::{Camera, View};
use crate::scene::SceneError;

/// A camera and how it was come by.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraChoice {
    /// The camera.
    pub camera: Camera,
    /// Where it is from, in one line, for the program to show.
    pub note: String,
    /// What was left out of its description, for the program to show.
    pub warnings: Vec<String>,
    /// Whether nobody described a camera and a view of the whole scene was made up: worth showing `note` unasked.
    pub fitted: bool,
}

/// The camera of a view that came from `whence`, with what is overridden.
pub(super) fn choose(view: View, whence: &str, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let note = format!("{whence}{}", overrides.said());
    let camera = Camera::new(overrides.apply(view), &note)?;
    Ok(CameraChoice { camera, note: format!("camera: {note}"), warnings: Vec::new(), fitted: false })
}
