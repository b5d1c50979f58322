//! How far a picture will look off, by FLIP, on small ones made here and now.

use super::pilots::Pilots;
use crate::pipe::Pipe;
use anyhow::Context as _;
use pm_plan::{Estimate, Recipe};
use pm_report::sheet::{Sheet, number};

/// Pixels of a small picture at least: what FLIP blurs is some pixels wide.
const PIXELS: f64 = 4096.0;
/// Small pictures that are held against the good one.
const PICTURES: u64 = 3;
/// Eye rays and photons of the good one, relative to theirs: its own noise adds a twentieth.
const BETTER: u32 = 9;
/// Seeds of these pictures are others than those by which time is measured.
const FIRST_SEED: u64 = 1000;
/// Photons at most.
const MOST_PHOTONS: u64 = 20_000_000;

/// The mean of `ldr_flip`, as pm-view has it, of pictures by this recipe.
///
/// # Errors
/// If one of the programs fails.
pub(super) fn measure(pilots: &Pilots<'_>, recipe: &Recipe) -> anyhow::Result<Estimate> {
    let folder = tempfile::tempdir().context("a folder for small pictures")?;
    let path = |name: &str| folder.path().join(name).display().to_string();
    let [width, height] = pilots.size.map(f64::from);
    let size = pilots.scaled((PIXELS / (width * height)).min(1.0));
    let more = |n: u64| (n * u64::from(BETTER)).min(MOST_PHOTONS.max(n));
    let samples = Recipe::grid(f64::from(recipe.samples) * f64::from(BETTER)).unwrap_or(recipe.samples);
    let better = Recipe { samples, photons: more(recipe.photons), caustics: more(recipe.caustics), ..*recipe };
    let good = path("good.exr");
    pilots.small(&better, size, FIRST_SEED, &good).run()?;
    let mut found = vec![];
    for picture in 1..=PICTURES {
        let one = path("one.exr");
        pilots.small(recipe, size, FIRST_SEED + picture, &one).run()?;
        let words = ["-q", &good, &one, "--format", "csv"].map(str::to_owned);
        let sheet = Sheet::parse("pm-view", &Pipe::new("pm-view", words).run()?)?;
        let row = sheet.rows().first().context("pm-view has printed no row")?;
        found.push(number(&row[sheet.column("ldr_flip")?]).context("pm-view has printed no ldr_flip")?);
    }
    Ok(Estimate::mean(&found))
}
