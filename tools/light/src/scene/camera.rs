//! From where a scene is seen: a pinhole camera, and where its description comes from.

pub(super) mod ecs;
mod file;
mod fit;
mod inside;

use std::path::PathBuf;

use glam::{DVec3, Vec3};

use super::{Bounds, SceneError};

/// The directions of view and up are parallel if the sine of the angle between them is below this.
const PARALLEL: f64 = 1e-6;
/// More pixels than this along a side are taken for a slip.
const LARGEST: u32 = 1 << 16;

/// What a camera description may leave out.
const UP: [f64; 3] = [0.0, 1.0, 0.0];
const VFOV: f64 = 45.0;
const SIZE: [u32; 2] = [512, 512];

/// A pinhole camera with square pixels. Pixel (0, 0) is the upper left one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    view: View,
    /// From the eye to the middle of the image plane at distance 1, and from there to its right and upper edge.
    forward: DVec3,
    right: DVec3,
    above: DVec3,
}

/// A camera as people describe it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct View {
    eye: [f64; 3],
    look_at: [f64; 3],
    up: [f64; 3],
    /// Vertical field of view, degrees.
    vfov: f64,
    /// Pixels across and down.
    size: [u32; 2],
}

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

impl Camera {
    /// The camera of a scene: from `NAME.camera.toml` beside the first OBJ that has one, else from Embree's `NAME.ecs`,
    /// else so placed that all of `bounds` is seen; `overrides` win over each of them.
    ///
    /// # Errors
    ///
    /// [`SceneError::Read`] for a camera file that is there but cannot be read, [`SceneError::Camera`] for one that makes
    /// no sense, or that does not with the overrides.
    pub fn find(obj: &[PathBuf], bounds: &Bounds, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
        if let Some(path) = obj.iter().map(|path| path.with_extension("camera.toml")).find(|path| path.exists()) {
            return file::parse(&read(&path)?, &path.display().to_string(), overrides);
        }
        if let Some(path) = obj.iter().map(|path| path.with_extension("ecs")).find(|path| path.exists()) {
            return ecs::parse(&read(&path)?, &path.display().to_string(), overrides);
        }
        fit::fit(bounds, overrides)
    }

    /// The camera of [`Scene::embedded`](super::Scene::embedded), 128 x 128 pixels.
    ///
    /// # Errors
    ///
    /// [`SceneError::Camera`] if it makes no sense with the overrides.
    pub fn embedded(overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
        file::parse(include_str!("../../../../scenes/cornell.camera.toml"), "built-in Cornell box", overrides)
    }

    /// Where the eye is.
    pub fn eye(&self) -> Vec3 {
        DVec3::from(self.view.eye).as_vec3()
    }

    /// The point in the middle of the image.
    pub fn look_at(&self) -> Vec3 {
        DVec3::from(self.view.look_at).as_vec3()
    }

    /// A direction that is upward in the image.
    pub fn up(&self) -> Vec3 {
        DVec3::from(self.view.up).as_vec3()
    }

    /// Vertical field of view, degrees.
    pub fn vfov(&self) -> f64 {
        self.view.vfov
    }

    /// Pixels across and down.
    pub fn size(&self) -> [u32; 2] {
        self.view.size
    }

    /// The ray through a point of the image, in pixels from its upper left corner: the middle of pixel (x, y) is
    /// (x + 0.5, y + 0.5). Gives the eye and a unit direction.
    pub fn ray(&self, px: f64, py: f64) -> (Vec3, Vec3) {
        let [width, height] = self.view.size.map(f64::from);
        let across = (2.0 * px / width - 1.0) * self.right;
        let up = (1.0 - 2.0 * py / height) * self.above;
        (self.eye(), (self.forward + across + up).normalize().as_vec3())
    }

    fn new(view: View, whence: &str) -> Result<Self, SceneError> {
        let bad = |what: &str| Err(SceneError::Camera { whence: whence.to_owned(), what: what.to_owned() });
        let [eye, look_at, up] = [view.eye, view.look_at, view.up].map(DVec3::from);
        // Like the vertices: what single precision cannot square is out of bounds.
        if ![eye, look_at, up].iter().all(|v| v.abs().max_element() <= 1e18) {
            return bad("eye, look_at and up must be finite and within 1e18 of the origin");
        }
        if !(view.vfov > 0.0 && view.vfov < 180.0) {
            return bad(&format!("vfov is {}; it must be above 0 and below 180 degrees", view.vfov));
        }
        let [width, height] = view.size;
        if width == 0 || height == 0 || width > LARGEST || height > LARGEST {
            return bad(&format!("size is {width} x {height}; each must be 1 to {LARGEST}"));
        }
        let Some(forward) = (look_at - eye).try_normalize() else {
            return bad("eye and look_at are the same point; move one of them");
        };
        let Some(up) = up.try_normalize() else {
            return bad("up has no direction; give one, such as 0 1 0");
        };
        let across = forward.cross(up);
        if across.length() < PARALLEL {
            return bad("up is parallel to the direction of view; give another, such as 0 0 1");
        }
        let half_height = libm::tan(view.vfov.to_radians() / 2.0);
        let half_width = half_height * f64::from(width) / f64::from(height);
        let right = across.normalize();
        Ok(Self { view, forward, right: right * half_width, above: right.cross(forward) * half_height })
    }
}

impl CameraOverrides {
    fn apply(&self, view: View) -> View {
        View {
            eye: self.eye.unwrap_or(view.eye),
            look_at: self.look_at.unwrap_or(view.look_at),
            up: self.up.unwrap_or(view.up),
            vfov: self.vfov.unwrap_or(view.vfov),
            size: self.size.unwrap_or(view.size),
        }
    }

    /// The names of what is overridden, to be added to a note or an error.
    fn said(&self) -> String {
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

fn choose(view: View, whence: &str, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let note = format!("{whence}{}", overrides.said());
    let camera = Camera::new(overrides.apply(view), &note)?;
    Ok(CameraChoice { camera, note: format!("camera: {note}"), warnings: Vec::new(), fitted: false })
}

fn read(path: &std::path::Path) -> Result<String, SceneError> {
    std::fs::read_to_string(path).map_err(|source| SceneError::Read { path: path.to_path_buf(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: View =
        View { eye: [0.0, 0.5, 1.94], look_at: [0.0, 0.5, 0.0], up: UP, vfov: 39.3077, size: [256, 256] };

    fn refused(view: View) -> String {
        Camera::new(view, "test").unwrap_err().to_string()
    }

    /// Does the light of the Cornell box lie where Mitsuba 3.9.1 has it? Its 256 x 256 image has the light's far edge at
    /// row 39.885, the near one at 30.944 (each +- 0.005) and that between columns 103.73 and 152.27.
    #[test]
    fn light_lies_where_another_renderer_has_it() {
        let camera = Camera::new(VIEW, "test").unwrap();
        let on_ceiling = |px, py| {
            let (eye, dir) = camera.ray(px, py);
            eye + dir * ((1.0 - eye.y) / dir.y)
        };
        // A hundredth of a pixel is 1e-4 across and 2e-4 in depth.
        let near = |p: Vec3, x: f32, z: f32| {
            assert!((p.x - x).abs() < 1e-4 && (p.z - z).abs() < 2e-4, "{p} is not {x}, {z}");
        };
        near(on_ceiling(103.73, 30.94), -0.125, 0.09375);
        near(on_ceiling(152.27, 30.94), 0.125, 0.09375);
        near(on_ceiling(128.0, 39.885), 0.0, -0.09375);
    }

    /// Are pixels square, the field of view vertical, and directions of unit length, in a wide image too?
    #[test]
    fn wide_image_keeps_the_vertical_field_of_view() {
        let camera = Camera::new(View { size: [200, 100], vfov: 90.0, ..VIEW }, "test").unwrap();
        let angle = |dir: Vec3| (dir.x / -dir.z, dir.y / -dir.z);
        assert_eq!(camera.ray(100.0, 50.0).1, Vec3::NEG_Z);
        let (x, y) = angle(camera.ray(0.0, 0.0).1);
        assert!((x + 2.0).abs() < 1e-6 && (y - 1.0).abs() < 1e-6, "{x} {y}");
        assert!((camera.ray(13.0, 77.0).1.length() - 1.0).abs() < 1e-6);
    }

    /// Is a camera that cannot see refused, saying which of its parts is at fault?
    #[test]
    fn senseless_cameras_are_refused() {
        assert!(refused(View { eye: VIEW.look_at, ..VIEW }).contains("same point"));
        assert!(refused(View { up: [0.0, 0.0, -3.0], ..VIEW }).contains("parallel"));
        assert!(refused(View { up: [0.0; 3], ..VIEW }).contains("no direction"));
        assert!(refused(View { size: [0, 5], ..VIEW }).contains("size is 0 x 5"));
        assert!(refused(View { eye: [f64::NAN; 3], ..VIEW }).contains("finite"));
        for vfov in [0.0, 180.0, -1.0, f64::NAN] {
            assert!(refused(View { vfov, ..VIEW }).contains("vfov is"), "{vfov}");
        }
    }

    /// Do scale and distance from the origin leave the view alone?
    #[test]
    fn tiny_and_distant_cameras_look_the_same_way() {
        let plain = Camera::new(VIEW, "test").unwrap().ray(3.0, 4.0).1;
        let tiny =
            Camera::new(View { eye: [0.0, 0.5e-6, 1.94e-6], look_at: [0.0, 0.5e-6, 0.0], ..VIEW }, "test").unwrap();
        let far = Camera::new(View { eye: [1e6, 0.5, 1.94], look_at: [1e6, 0.5, 0.0], ..VIEW }, "test").unwrap();
        assert!((tiny.ray(3.0, 4.0).1 - plain).length() < 1e-6);
        assert!((far.ray(3.0, 4.0).1 - plain).length() < 1e-6);
    }
}
