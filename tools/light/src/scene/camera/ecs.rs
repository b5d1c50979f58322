//! Embree's scene description `NAME.ecs`: command-line options in a file, of which camera and area lights are read.

use super::{CameraChoice, CameraOverrides, SIZE, SceneError, UP, VFOV, View, choose};
use crate::scene::{Place, QuadLight};
use std::path::Path;

/// What an `.ecs` file says.
#[derive(Debug, Default)]
struct Ecs<'a> {
    eye: Option<[f64; 3]>,
    look_at: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    vfov: Option<f64>,
    size: Option<[u32; 2]>,
    /// Area lights, and where they are described.
    lights: Vec<(Place, QuadLight)>,
    /// Lights without an area, by their options.
    other_lights: Vec<&'a str>,
    others: Vec<&'a str>,
}

fn read<'a>(text: &'a str, whence: &str) -> Result<Ecs<'a>, SceneError> {
    let mut ecs = Ecs::default();
    for (number, line) in (1..).zip(text.lines()) {
        let mut words = line.split_whitespace().take_while(|word| !word.starts_with('#')).peekable();
        while let Some(option) = words.next() {
            let mut value = || -> Result<f64, SceneError> {
                let word = words.next().unwrap_or("nothing");
                word.parse().map_err(|_| SceneError::Camera {
                    whence: format!("{whence}:{number}"),
                    what: format!("{option} wants a number, not {word:?}"),
                })
            };
            let mut three = || -> Result<[f64; 3], SceneError> { Ok([value()?, value()?, value()?]) };
            match option.strip_prefix('-').map(|rest| rest.strip_prefix('-').unwrap_or(rest)) {
                Some("vp") => ecs.eye = Some(three()?),
                Some("vi") => ecs.look_at = Some(three()?),
                Some("vu") => ecs.up = Some(three()?),
                Some("fov") => ecs.vfov = Some(value()?),
                Some("size") => ecs.size = Some([value()? as u32, value()? as u32]),
                Some("quadlight") => {
                    let light = QuadLight { corner: three()?, u: three()?, v: three()?, radiance: three()? };
                    ecs.lights.push((Place::new(Path::new(whence), number), light));
                }
                Some("i") => while words.next_if(|word| !is_option(word)).is_some() {}, // the OBJ we are beside
                _ => {
                    let kind = if option.contains("light") { &mut ecs.other_lights } else { &mut ecs.others };
                    if is_option(option) && !kind.contains(&option) {
                        kind.push(option);
                    }
                }
            }
        }
    }
    Ok(ecs)
}

/// Reads the camera of an `.ecs` file that came from `whence`; what is neither camera nor light is named in a warning.
pub(super) fn parse(text: &str, whence: &str, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let ecs = read(text, whence)?;
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

/// Area lights, each with where it was read, and a warning about other lights.
type Lights = (Vec<(Place, QuadLight)>, Option<String>);

/// Reads the area lights of an `.ecs` file that came from `whence`, and a warning if it has lights of other kinds.
///
/// # Errors
/// [`SceneError::Camera`] for what should be a number and is none.
pub(crate) fn lights(text: &str, whence: &str) -> Result<Lights, SceneError> {
    let ecs = read(text, whence)?;
    let warning = (!ecs.other_lights.is_empty()).then(|| {
        let names = ecs.other_lights.join(" ");
        format!("{whence}: {names} not read: lights have an area here; --quad-light adds one of that place and size")
    });
    Ok((ecs.lights, warning))
}

/// Options begin with a minus and a letter, numbers do not.
fn is_option(word: &str) -> bool {
    word.trim_start_matches('-').starts_with(|c: char| c.is_ascii_alphabetic()) && word.starts_with('-')
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// Are Embree's camera and area lights read, and lights of other kinds named rather than lost?
    #[test]
    fn camera_and_area_lights_are_read() {
        let text = "-i crown.obj  # the model\n-vp 1 2 3 -vi -4 5 6\n-vu 0 0 1 -fov 37\n-size 640 480\n\
                    -quadlight 0 9 0 1 0 0 0 0 1 5 5 5\n-pointlight 1 1 1 2 2 2 --threads 4\n";
        let choice = parse(text, "crown.ecs", &CameraOverrides::default()).unwrap();
        let camera = choice.camera;
        assert_eq!((camera.eye(), camera.look_at()), (Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 5.0, 6.0)));
        assert_eq!((camera.up(), camera.vfov(), camera.size()), (Vec3::Z, 37.0, [640, 480]));
        assert_eq!(choice.warnings, ["crown.ecs: --threads ignored"]);
        let (lights, warning) = lights(text, "crown.ecs").unwrap();
        let light = QuadLight { corner: [0., 9., 0.], u: [1., 0., 0.], v: [0., 0., 1.], radiance: [5.; 3] };
        assert_eq!(lights, [(Place::new(Path::new("crown.ecs"), 5), light)]);
        assert!(warning.unwrap().starts_with("crown.ecs: -pointlight not read"));
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
