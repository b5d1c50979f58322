//! Embree's scene description `NAME.ecs`: command-line options in a file, of which the camera's are read.

use super::{CameraChoice, CameraOverrides, SIZE, SceneError, UP, VFOV, View, choose};

/// Reads the camera of an `.ecs` file that came from `whence`; its lights and all else are named in a warning.
pub(super) fn parse(text: &str, whence: &str, overrides: &CameraOverrides) -> Result<CameraChoice, SceneError> {
    let mut eye = None;
    let mut look_at = None;
    let mut view = View { eye: [0.0; 3], look_at: [0.0; 3], up: UP, vfov: VFOV, size: SIZE };
    let mut lights: Vec<&str> = Vec::new();
    let mut others: Vec<&str> = Vec::new();
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
            match option {
                "-vp" => eye = Some([value()?, value()?, value()?]),
                "-vi" => look_at = Some([value()?, value()?, value()?]),
                "-vu" => view.up = [value()?, value()?, value()?],
                "-fov" => view.vfov = value()?,
                "-size" => view.size = [value()? as u32, value()? as u32],
                "-i" => while words.next_if(|word| !is_option(word)).is_some() {}, // the OBJ we are beside
                _ => {
                    let kind = if option.contains("light") { &mut lights } else { &mut others };
                    if is_option(option) && !kind.contains(&option) {
                        kind.push(option);
                    }
                }
            }
        }
    }
    let place = |point: Option<[f64; 3]>, given: Option<[f64; 3]>, option: &str, what: &str| {
        point.or(given).ok_or_else(|| SceneError::Camera {
            whence: whence.to_owned(),
            what: format!("no {option} in the file; give {what}"),
        })
    };
    view.eye = place(eye, overrides.eye, "-vp", "the eye")?;
    view.look_at = place(look_at, overrides.look_at, "-vi", "the point to look at")?;
    let mut choice = choose(view, whence, overrides)?;
    if !lights.is_empty() {
        let warning =
            format!("{whence}: {} not read; add an OBJ with a light of that place and size", lights.join(" "));
        choice.warnings.push(warning);
    }
    if !others.is_empty() {
        choice.warnings.push(format!("{whence}: {} ignored", others.join(" ")));
    }
    Ok(choice)
}

/// Options begin with a minus and a letter, numbers do not.
fn is_option(word: &str) -> bool {
    word.strip_prefix('-').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_alphabetic()))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// Is Embree's camera read, and are its lights named rather than lost?
    #[test]
    fn camera_is_read_and_lights_are_named() {
        let text = "-i crown.obj  # the model\n-vp 1 2 3 -vi -4 5 6\n-vu 0 0 1 -fov 37\n-size 640 480\n\
                    -quadlight 0 9 0 1 0 0 0 0 1 5 5 5\n-pointlight 1 1 1 2 2 2 --threads 4\n";
        let choice = parse(text, "crown.ecs", &CameraOverrides::default()).unwrap();
        let camera = choice.camera;
        assert_eq!((camera.eye(), camera.look_at()), (Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 5.0, 6.0)));
        assert_eq!((camera.up(), camera.vfov(), camera.size()), (Vec3::Z, 37.0, [640, 480]));
        assert_eq!(choice.warnings.len(), 1, "{:?}", choice.warnings);
        assert!(choice.warnings[0].starts_with("crown.ecs: -quadlight -pointlight not read"));
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
