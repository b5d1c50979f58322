//! A pinhole camera, and the rays through its pixels.

use crate::scene::SceneError;
use glam::{DVec3, Vec3};

#[cfg(test)]
mod tests;

/// The directions of view and up are parallel if the sine of the angle between them is below this.
const PARALLEL: f64 = 1e-6;
/// More pixels than this along a side are taken for a slip.
const LARGEST: u32 = 1 << 16;

/// What a camera description may leave out.
pub(super) const UP: [f64; 3] = [0.0, 1.0, 0.0];
pub(super) const VFOV: f64 = 45.0;
pub(super) const SIZE: [u32; 2] = [512, 512];

/// A pinhole camera with square pixels. Pixel (0, 0) is the upper left one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    pub(super) view: View,
    /// From the eye to the middle of the image plane at distance 1, and from there to its right and upper edge.
    forward: DVec3,
    right: DVec3,
    above: DVec3,
}

/// A camera as people describe it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct View {
    pub(super) eye: [f64; 3],
    pub(super) look_at: [f64; 3],
    pub(super) up: [f64; 3],
    /// Vertical field of view, degrees.
    pub(super) vfov: f64,
    /// Pixels across and down.
    pub(super) size: [u32; 2],
}

impl Camera {
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

    pub(super) fn new(view: View, whence: &str) -> Result<Self, SceneError> {
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
