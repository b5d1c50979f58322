//! From files to a scene.

use super::builder::Builder;
use super::ecs::{self, PlacedLight};
use super::error::SceneError;
use super::files::Files;
use super::obj;
use super::options::LoadOptions;
use super::triangles::Scene;
use super::warnings::Warnings;
use std::path::{Path, PathBuf};

impl Scene {
    /// Reads OBJ files and the material libraries they name, and merges them into one scene. Materials of one file are
    /// not seen by another.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, a statement that cannot be obeyed (with file and line), a scene without faces or
    /// without light.
    pub fn load(paths: &[PathBuf], options: &LoadOptions, files: &dyn Files) -> Result<Self, SceneError> {
        let mut warnings = Warnings::new(options.strict);
        let mut builder = Builder::new(names(paths));
        for path in paths {
            let parsed = obj::parse(path, files, &mut warnings)?;
            builder.add(path, &parsed, options, files, &mut warnings)?;
        }
        let lights = embree_lights(paths, files, &mut warnings)?;
        let allow_dark = options.allow_dark || !lights.is_empty();
        let mut scene = builder.finish(&LoadOptions { allow_dark, ..*options }, warnings)?;
        for (place, light) in &lights {
            scene.add_quad_light(&place.to_string(), light)?;
        }
        Ok(scene)
    }

    /// The Cornell box with a mirror and a glass sphere, built into the program. Its camera is
    /// [`Camera::embedded`](super::Camera::embedded).
    pub fn embedded() -> Self {
        let built_in = |path: &Path| match path.to_str() {
            Some("cornell.obj") => Ok(include_bytes!("../../scenes/cornell.obj").to_vec()),
            Some("cornell.mtl") => Ok(include_bytes!("../../scenes/cornell.mtl").to_vec()),
            _ => Err(std::io::ErrorKind::NotFound.into()),
        };
        let scene = Self::load(&["cornell.obj".into()], &LoadOptions::default(), &built_in);
        scene.expect("the built-in scene is part of the program and covered by its tests")
    }
}

/// The area lights of Embree's `NAME.ecs` beside each OBJ that has one.
fn embree_lights(
    paths: &[PathBuf],
    files: &dyn Files,
    warnings: &mut Warnings,
) -> Result<Vec<PlacedLight>, SceneError> {
    let mut all = vec![];
    for path in paths.iter().map(|path| path.with_extension("ecs")) {
        let Ok(bytes) = files.read_named(&path) else { continue };
        let (lights, warning) = ecs::lights(&String::from_utf8_lossy(&bytes), &path.display().to_string())?;
        all.extend(lights);
        warning.into_iter().for_each(|warning| warnings.say(warning));
    }
    Ok(all)
}

fn names(paths: &[PathBuf]) -> String {
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    if names.is_empty() { "no OBJ file given".into() } else { names.join(", ") }
}
