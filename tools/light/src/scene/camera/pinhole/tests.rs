//! Do rays go where another renderer sends them, and is a camera that cannot see refused?

use super::*;

const VIEW: View = View { eye: [0.0, 0.5, 1.94], look_at: [0.0, 0.5, 0.0], up: UP, vfov: 39.3077, size: [256, 256] };

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
    let tiny = Camera::new(View { eye: [0.0, 0.5e-6, 1.94e-6], look_at: [0.0, 0.5e-6, 0.0], ..VIEW }, "test").unwrap();
    let far = Camera::new(View { eye: [1e6, 0.5, 1.94], look_at: [1e6, 0.5, 0.0], ..VIEW }, "test").unwrap();
    assert!((tiny.ray(3.0, 4.0).1 - plain).length() < 1e-6);
    assert!((far.ray(3.0, 4.0).1 - plain).length() < 1e-6);
}
