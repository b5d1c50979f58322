//! `pm-picture`: makes a picture with the other programs, and prints the pipes by which it does.

mod args;
pub(crate) mod caustics;
mod recipe;

use crate::asked::Asked;
use crate::cli::{Program, Typed, create_output, picture_format, usage};
use crate::pipe::Pipe;
use anyhow::{Context as _, bail};
pub use args::Args;
use clap::CommandFactory as _;
use pm_light::transport::Surfaces;
use recipe::Recipe;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The program.
#[must_use]
pub fn program() -> Program<Asked<Args>> {
    Program::new("pm-picture", Args::command(), Asked::read)
}

/// Does what was asked.
///
/// # Errors
/// If it was asked wrongly, the scene cannot be loaded, or one of the programs fails.
pub fn run(Asked { args, scene, camera }: Asked<Args>, _: &Typed) -> anyhow::Result<()> {
    check(&args)?;
    // What there is to say of the scene is said by the first program that loads it.
    let loaded = args.scene.load(&args.hushed())?;
    args.scene.camera(&loaded, &args.camera, &args.hushed())?;
    let caustics = caustics::found(&Surfaces::new(&loaded), args.caustics, args.seed).map_or(0, |(photons, _)| photons);
    drop(loaded);

    let temporary = match (&args.keep, args.dry_run) {
        (None, false) => Some(tempfile::tempdir().context("a folder for the streams")?),
        _ => None,
    };
    let folder = temporary.as_ref().map(|folder| folder.path().to_owned()).or_else(|| args.keep.clone());
    let folder = folder.unwrap_or_else(|| PathBuf::from("."));
    if !args.dry_run {
        std::fs::create_dir_all(&folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
    }
    let recipe = Recipe { args: &args, scene, camera, folder, caustics };
    for pipe in recipe.maps().into_iter().chain(recipe.gathers()) {
        if !args.common.quiet {
            // Each before it runs: it is what a long wait is for.
            let mut output = create_output(Path::new("-"))?;
            writeln!(output, "{pipe}")?;
            output.commit()?;
        }
        if !args.dry_run {
            pipe.run()?;
        }
    }
    Ok(())
}

/// The pipes that make a picture once its photon maps are in `folder`, of which one has so many photons of caustics, or 0: there is none.
///
/// # Errors
/// If it is asked wrongly.
pub(crate) fn gathers(
    asked: impl IntoIterator<Item = String>,
    caustics: u64,
    folder: PathBuf,
) -> anyhow::Result<Vec<Pipe>> {
    let words = std::iter::once("pm-picture".to_owned()).chain(asked);
    let Asked { args, scene, camera } = Asked::<Args>::read(&Args::command().try_get_matches_from(words)?)?;
    Ok(Recipe { args: &args, scene, camera, folder, caustics }.gathers())
}

/// Refuses what would fail at the end of a long wait.
fn check(args: &Args) -> anyhow::Result<()> {
    for image in &args.image {
        if image == Path::new("-") {
            return Err(usage("--image: the pipes are printed on standard output; name a file for the picture"));
        }
        picture_format(image)?;
        let folder = image.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            bail!("{}: there is no folder {}", image.display(), folder.display());
        }
    }
    if args.caustics == 0 && args.caustics_k.is_some() {
        return Err(usage("--caustics-k is for a map of caustics, and --caustics 0 makes none: leave out one of them"));
    }
    Ok(())
}
