//! A view of the whole scene, for when nobody described one.

use glam::DVec3;

use super::choice::{CameraChoice, choose};
use super::looks::first_hit;
use super::overrides::CameraOverrides;
use super::pinhole::{SIZE, UP, VFOV, View};
use crate::scene::{Bounds, Scene, SceneError};

/// Space left around the scene, as a share of it.
const MARGIN: f64 = 1.05;

/// Vertical field of view in a room, degrees: a room is seen from near by.
const VFOV_WITHIN: f64 = 70.0;
/// Share of the way from the middle of a room to its wall, where the camera stands.
const WITHIN: f64 = 0.95;

/// A view of the whole scene from before it, or from within if no light is seen from there, but is from within: a closed
/// room.
pub(super) fn fit(scene: &Scene, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let outside = before(&scene.bounds, overrides)?;
    if overrides.eye.is_some() || scene.lights().is_empty() || outside.camera.sees_light(scene) {
        return Ok(outside);
    }
    let inside = within(scene, overrides)?;
    Ok(if inside.camera.sees_light(scene) { inside } else { outside })
}

/// Looks along -z at the middle of the bounds, from as near as can be to the first surface behind it.
fn within(scene: &Scene, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let centre = scene.bounds.centre().as_dvec3();
    let half = f64::from(scene.bounds.size().z) / 2.0;
    let way = first_hit(scene, centre, DVec3::Z, |_| true).map_or(half, |hit| hit.t);
    let eye = centre + DVec3::Z * (WITHIN * way).max(1e-3 * half);
    let view = View {
        eye: eye.to_array(),
        look_at: centre.to_array(),
        up: UP,
        vfov: overrides.vfov.unwrap_or(VFOV_WITHIN),
        size: overrides.size.unwrap_or(SIZE),
    };
    fitted(view, "no camera file, and no light is seen from before the scene: looking within it", overrides)
}

/// Looks along -z at the middle of `bounds`, from so far in front that all of its front face is in the picture.
fn before(bounds: &Bounds, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
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
    fitted(view, "no camera file: looking", overrides)
}

/// The camera of a view that nobody described, and a note that says so.
fn fitted(view: View, why: &str, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let mut choice = choose(view, "fitted to the scene", overrides)?;
    let camera = &choice.camera.view;
    choice.fitted = true;
    choice.note = format!(
        "{why} from {} at {}, up {}, vfov {}, size {} {}{}",
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
            let choice = before(&Bounds { min, max }, &overrides).unwrap();
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
        let choice = before(&bounds, &overrides).unwrap();
        assert_eq!((choice.camera.eye(), choice.camera.look_at()), (Vec3::splat(9.0), Vec3::splat(0.5)));
        assert!(choice.note.ends_with("; eye by option"));
        let silly = CameraOverrides { size: Some([5, 0]), ..Default::default() };
        assert!(before(&bounds, &silly).unwrap_err().to_string().contains("size is 5 x 0"));
    }

    /// A cube of one material, its faces turned outward or inward, with a lamp under its ceiling.
    fn room(outward: bool) -> Scene {
        let corner = |i: i32| format!("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2 & 1);
        let mut obj: String = "mtllib m.mtl\n".to_owned() + &(0..8).map(corner).collect::<String>();
        obj += "v .4 .9 .4\nv .6 .9 .4\nv .6 .9 .6\nv .4 .9 .6\nusemtl lamp\nf 9 10 11 12\nusemtl wall\n";
        for mut face in [[1, 5, 7, 3], [2, 4, 8, 6], [1, 2, 6, 5], [3, 7, 8, 4], [1, 3, 4, 2], [5, 6, 8, 7]] {
            if !outward {
                face.reverse();
            }
            obj += &format!("f {} {} {} {}\n", face[0], face[1], face[2], face[3]);
        }
        let files = |path: &std::path::Path| match path.to_str() {
            Some("t.obj") => Ok(obj.clone().into_bytes()),
            Some("m.mtl") => Ok(b"newmtl wall\nKd .5\nnewmtl lamp\nKd 0\nKe 9\n".to_vec()),
            _ => Err(std::io::ErrorKind::NotFound.into()),
        };
        Scene::load(&["t.obj".into()], &crate::scene::LoadOptions::default(), &files).unwrap()
    }

    /// Does the camera of a closed room stand in it, whichever way its walls face, and that of an open one before it?
    #[test]
    fn a_closed_room_is_seen_from_within() {
        for outward in [false, true] {
            let scene = room(outward);
            let choice = fit(&scene, &CameraOverrides::default()).unwrap();
            let eye = choice.camera.eye();
            assert!(eye.cmpgt(Vec3::ZERO).all() && eye.cmplt(Vec3::ONE).all() && eye.z > 0.9, "{eye}");
            assert!(choice.fitted && choice.note.contains("looking within it from 0.5 0.5"), "{}", choice.note);
            let told = CameraOverrides { eye: Some([0.5, 0.5, 4.0]), ..Default::default() };
            assert_eq!(fit(&scene, &told).unwrap().camera.eye().z, 4.0);
        }
        let cornell = fit(&Scene::embedded(), &CameraOverrides::default()).unwrap();
        assert!(cornell.camera.eye().z > 1.0 && cornell.note.starts_with("no camera file: looking from"));
    }
}
