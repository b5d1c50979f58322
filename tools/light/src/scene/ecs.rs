//! Embree's scene description `NAME.ecs`: command-line options in a file, of which camera and area lights are read.

use super::error::{FileLine, SceneError};
use super::quad_light::QuadLight;
use std::path::Path;

/// What an `.ecs` file says.
#[derive(Debug, Default)]
pub(super) struct Ecs<'a> {
    pub(super) eye: Option<[f64; 3]>,
    pub(super) look_at: Option<[f64; 3]>,
    pub(super) up: Option<[f64; 3]>,
    pub(super) vfov: Option<f64>,
    pub(super) size: Option<[u32; 2]>,
    /// Area lights, and where they are described.
    lights: Vec<PlacedLight>,
    /// Lights without an area, by their options.
    other_lights: Vec<&'a str>,
    /// Options that are neither camera nor light.
    pub(super) others: Vec<&'a str>,
}

/// Reads an `.ecs` file that came from `whence`.
///
/// # Errors
/// [`SceneError::Camera`] for what should be a number and is none.
pub(super) fn read<'a>(text: &'a str, whence: &str) -> Result<Ecs<'a>, SceneError> {
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
                    ecs.lights.push((FileLine::new(Path::new(whence), number), light));
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

/// An area light, and where it is described.
pub(super) type PlacedLight = (FileLine, QuadLight);

/// Area lights, and a warning about other lights.
type Lights = (Vec<PlacedLight>, Option<String>);

/// Reads the area lights of an `.ecs` file that came from `whence`, and a warning if it has lights of other kinds.
///
/// # Errors
/// [`SceneError::Camera`] for what should be a number and is none.
pub(super) fn lights(text: &str, whence: &str) -> Result<Lights, SceneError> {
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
    use super::*;

    /// Are Embree's area lights read, and lights of other kinds named rather than lost?
    #[test]
    fn area_lights_are_read() {
        let text = "-i crown.obj  # the model\n-vp 1 2 3 -vi -4 5 6\n-vu 0 0 1 -fov 37\n-size 640 480\n\
                    -quadlight 0 9 0 1 0 0 0 0 1 5 5 5\n-pointlight 1 1 1 2 2 2 --threads 4\n";
        let (lights, warning) = lights(text, "crown.ecs").unwrap();
        let light = QuadLight { corner: [0., 9., 0.], u: [1., 0., 0.], v: [0., 0., 1.], radiance: [5.; 3] };
        assert_eq!(lights, [(FileLine::new(Path::new("crown.ecs"), 5), light)]);
        assert!(warning.unwrap().starts_with("crown.ecs: -pointlight not read"));
    }
}
