//! The base picture: light that needs no query, direct and emitted.

use crate::cli::{Output, PART, create_output, room_for, write_picture};
use crate::gather::FILM_BYTES;
use anyhow::Context as _;
use glam::Vec3;
use pm_film::film::{Film, Overflow, Units};
use pm_formats::vocabulary::Part;
use pm_light::scene::Scene;
use pm_pictures::Picture;
use std::path::{Path, PathBuf};

/// The picture in the making.
pub(super) struct Base {
    path: PathBuf,
    file: Output,
    size: [u32; 2],
    film: Film,
    part: Option<Part>,
}

impl Base {
    /// A black picture of a scene, to be written to a file.
    pub(super) fn create(path: &Path, size: [u32; 2], scene: &Scene, part: Option<Part>) -> anyhow::Result<Self> {
        let pixels = usize::try_from(u64::from(size[0]) * u64::from(size[1]))?;
        room_for((pixels as u64).saturating_mul(FILM_BYTES), "the base picture")?;
        let file = create_output(path)?;
        Ok(Self { path: path.to_owned(), file, size, film: Film::new(pixels, light_scale(scene)), part })
    }

    /// Adds what [`Exposure::light`] collected.
    pub(super) fn add(&mut self, light: Vec<(u32, Units)>) -> Result<(), Overflow> {
        light.into_iter().try_for_each(|(pixel, units)| self.film.add(pixel, units))
    }

    /// Writes the picture.
    pub(super) fn finish(self) -> anyhow::Result<()> {
        let Self { path, mut file, size, film, part } = self;
        let attributes: Vec<_> = part.iter().map(|part| (PART, part.to_string())).collect();
        write_picture(&Picture { size, pixels: film.pixels() }, &path, &mut file, &attributes)?;
        file.commit().with_context(|| path.display().to_string())
    }
}

/// What threads need to know of the film: its unit.
pub(super) struct Exposure(Film);

impl Exposure {
    /// The unit of all pictures of a scene.
    pub(super) fn new(scene: &Scene) -> Self {
        Self(Film::new(0, light_scale(scene)))
    }

    /// Radiance in units of the film.
    pub(super) fn quantise(&self, pixel: u32, radiance: Vec3) -> Result<Units, Overflow> {
        self.0.quantise(radiance.as_dvec3().into()).ok_or(Overflow(pixel))
    }
}

/// Radiance that the lights' flux suggests for a scene of this size.
fn light_scale(scene: &Scene) -> f64 {
    let flux = scene.emitted_flux().into_iter().fold(0.0, f64::max);
    flux / scene.bounds.size().as_dvec3().length_squared()
}
