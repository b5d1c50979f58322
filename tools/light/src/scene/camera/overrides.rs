//! What the command line says about the camera.

use super::pinhole::View;

/// What the command line says about the camera; it wins over files.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CameraOverrides {
    /// Where the eye is.
    pub eye: Option<[f64; 3]>,
    /// The point in the middle of the image.
    pub look_at: Option<[f64; 3]>,
    /// A direction that is upward in the image.
    pub up: Option<[f64; 3]>,
    /// Vertical field of view, degrees.
    pub vfov: Option<f64>,
    /// Pixels across and down.
    pub size: Option<[u32; 2]>,
}

impl CameraOverrides {
    /// The view with what is overridden.
    pub(super) fn apply(&self, view: View) -> View {
        View {
            eye: self.eye.unwrap_or(view.eye),
            look_at: self.look_at.unwrap_or(view.look_at),
            up: self.up.unwrap_or(view.up),
            vfov: self.vfov.unwrap_or(view.vfov),
            size: self.size.unwrap_or(view.size),
        }
    }

    /// The names of what is overridden, to be added to a note or an error.
    pub(super) fn said(&self) -> String {
        let given = [
            ("eye", self.eye.is_some()),
            ("look_at", self.look_at.is_some()),
            ("up", self.up.is_some()),
            ("vfov", self.vfov.is_some()),
            ("size", self.size.is_some()),
        ];
        let names: Vec<&str> = given.iter().filter(|(_, is)| *is).map(|(name, _)| *name).collect();
        if names.is_empty() { String::new() } else { format!("; {} by option", names.join(", ")) }
    }
}
