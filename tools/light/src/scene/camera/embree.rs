//! The camera of Embree's `NAME.ecs`.

use super::choice::{CameraChoice, choose};
use super::overrides::CameraOverrides;
use super::pinhole::{SIZE, UP, VFOV, View};
use crate::scene::SceneError;
use crate::scene::ecs;

/// Reads the camera of an `.ecs` file that came from `whence`; what is neither camera nor light is named in a warning.
pub(super) fn parse(text: &str, whence: &str, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let ecs = ecs::read(text, whence)?;
    let place = |point: Option<[f64; 3]>, given: Option<[f64; 3]>, option: &str, what: &str| {
        point.or(given).ok_or_else(|| SceneError::Camera {
            whence: whence.to_owned(),
            what: format!("no {option} in the file; give {what}"),
        })
    };
    let view = View {
        eye: place(ecs.eye, overrides.eye, "-vp", "the eye")?,
        look_at: place(ecs.look_at, overrides.look_at, "-vi", "the point to look at")?,
        up: ecs.up.unwrap_or(UP),
        vfov: ecs.vfov.unwrap_or(VFOV),
        size: ecs.size.unwrap_or(SIZE),
    };
    let mut choice = choose(view, whence, overrides)?;
    if !ecs.others.is_empty() {
        choice.warnings.push(format!("{whence}: {} ignored", ecs.others.join(" ")));
    }
    Ok(choice)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// Is Embree's camera read, and what is no camera named rather than lost?
    #[test]
    fn camera_is_read() {
        let text = "-i crown.obj  # the model\n-vp 1 2 3 -vi -4 5 6\n-vu 0 0 1 -fov 37\n-size 640 480\n\
                    -quadlight 0 9 0 1 0 0 0 0 1 5 5 5\n-pointlight 1 1 1 2 2 2 --threads 4\n";
        let choice = parse(text, "crown.ecs", &CameraOverrides::default()).unwrap();
        let camera = choice.camera;
        assert_eq!((camera.eye(), camera.look_at()), (Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 5.0, 6.0)));
        assert_eq!((camera.up(), camera.vfov(), camera.size()), (Vec3::Z, 37.0, [640, 480]));
        assert_eq!(choice.warnings, ["crown.ecs: --threads ignored"]);
    }

    /// Does a bad or missing number name its line and option?
    #[test]
    fn bad_numbers_are_named() {
        let error = |text| parse(text, "a.ecs", &CameraOverrides::default()).unwrap_err().to_string();
        assert_eq!(error("-vp 1 2 3\n-vi 0 x 0"), "camera (a.ecs:2): -vi wants a number, not \"x\"");
        assert_eq!(error("-vi 0 0"), "camera (a.ecs:1): -vi wants a number, not \"nothing\"");
        assert_eq!(error("-vi 0 0 0"), "camera (a.ecs): no -vp in the file; give the eye");
    }
}
