//! A view of the whole scene, for when nobody described one.

use glam::DVec3;

use super::choice::{CameraChoice, choose};
use super::overrides::CameraOverrides;
use super::pinhole::{SIZE, UP, VFOV, View};
use crate::scene::{Bounds, SceneError};

/// Space left around the scene, as a share of it.
const MARGIN: f64 = 1.05;

/// Looks along -z at the middle of `bounds`, from so far in front that all of its front face is in the picture.
pub(super) fn fit(bounds: &Bounds, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let vfov = overrides.vfov.unwrap_or(VFOV);
    let size = overrides.size.unwrap_or(SIZE);
    let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
    let (centre, half) = ((min + max) / 2.0, (max - min) / 2.0);
    let half_height = libm::tan(vfov.to_radians() / 2.0);
    let half_width = half_height * f64::from(size[0]) / f64::from(size[1]);
    let away = half.z + MARGIN * (half.y / half_height).max(half.x / half_width);
    // A scene may be flat and seen edge-on: then its depth sets the distance.
    let away = if away.is_finite() && away > half.z { away } else { 2.0 * half.z + 1.0 };
    let eye = centre + DVec3::Z * away;
    let view = View { eye: eye.to_array(), look_at: centre.to_array(), up: UP, vfov, size };
    let mut choice = choose(view, "fitted to the scene", overrides)?;
    let camera = &choice.camera.view;
    choice.fitted = true;
    choice.note = format!(
        "no camera file: looking from {} at {}, up {}, vfov {}, size {} {}{}",
        point(camera.eye),
        point(camera.look_at),
        point(camera.up),
        camera.vfov,
        camera.size[0],
        camera.size[1],
        overrides.said()
    );
    Ok(choice)
}

fn point(p: [f64; 3]) -> String {
    let [x, y, z] = p.map(|c| c as f32);
    format!("{x} {y} {z}")
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// Do all corners of a box project into the picture, whatever its shape, size and place?
    #[test]
    fn whole_box_is_seen() {
        let boxes = [
            (Vec3::new(-0.5, 0.0, -0.5), Vec3::new(0.5, 1.0, 0.5)),
            (Vec3::new(-50.0, 0.0, -1.0), Vec3::new(50.0, 1.0, 1.0)),
            (Vec3::splat(1e-6), Vec3::splat(2e-6)),
            (Vec3::new(1e6, 0.0, 0.0), Vec3::new(1e6 + 2.0, 5.0, 1.0)),
            (Vec3::ZERO, Vec3::new(0.0, 0.0, 3.0)),
            (Vec3::ZERO, Vec3::ZERO),
        ];
        for (min, max) in boxes {
            let overrides = CameraOverrides { size: Some([300, 200]), ..Default::default() };
            let choice = fit(&Bounds { min, max }, &overrides).unwrap();
            let camera = choice.camera;
            let corner = camera.ray(0.0, 0.0).1;
            let (across, up) = (corner.x / corner.z, corner.y / -corner.z);
            for p in [min, max] {
                let to = p - camera.eye();
                assert!(to.z < 0.0 && (to.x / to.z).abs() <= across && (to.y / to.z).abs() <= up, "{min} {max}");
            }
            assert!(choice.fitted && choice.note.starts_with("no camera file: looking from"), "{}", choice.note);
        }
    }

    /// Does one overridden part leave the others fitted?
    #[test]
    fn overrides_win() {
        let bounds = Bounds { min: Vec3::ZERO, max: Vec3::ONE };
        let overrides = CameraOverrides { eye: Some([9.0, 9.0, 9.0]), ..Default::default() };
        let choice = fit(&bounds, &overrides).unwrap();
        assert_eq!((choice.camera.eye(), choice.camera.look_at()), (Vec3::splat(9.0), Vec3::splat(0.5)));
        assert!(choice.note.ends_with("; eye by option"));
        let silly = CameraOverrides { size: Some([5, 0]), ..Default::default() };
        assert!(fit(&bounds, &silly).unwrap_err().to_string().contains("size is 5 x 0"));
    }
}
