//! `pm-scene`: writes scenes that are made by rule: OBJ, MTL and camera file.

use crate::cli::{self, Chooser, Common, Program, Typed, create_output, usage};
use anyhow::Context as _;
use clap::{Arg, CommandFactory, FromArgMatches, Parser};
use pm_light::make_scene::Recipe;
use pm_registry::{Chosen, Registry};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Make a scene: NAME.obj, NAME.mtl and NAME.camera.toml, the same bytes whenever and wherever they are made.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// Folder for the three files, or the OBJ file, beside which the others go
    #[arg(short, long, value_name = "FOLDER|FILE.obj")]
    output: PathBuf,
    #[command(flatten)]
    common: Common,
}

const EXAMPLES: &str = "\
Examples:
  pm-scene fractal -o scenes
  pm-scene columns --triangles 500000 -o hall.obj";

/// What was asked: which scene, and where it goes.
pub struct Asked {
    args: Args,
    recipe: Chosen<dyn Recipe>,
}

/// The program, with these scenes to choose from.
#[must_use]
pub fn program(recipes: &Registry<dyn Recipe>) -> Program<Asked> {
    let chooser = Chooser::positional(recipes, Arg::new("name").value_name("NAME").help("Which scene"));
    let command = chooser.add_parameters(chooser.add_word(Args::command()));
    Program::new("pm-scene", command, move |matches| {
        Ok(Asked { args: Args::from_arg_matches(matches)?, recipe: chooser.read(matches)? })
    })
}

/// Does what was asked.
///
/// # Errors
/// If it was asked wrongly, or the files cannot be written.
pub fn run(Asked { args, recipe: Chosen { entry: recipe, values } }: Asked, _: &Typed) -> anyhow::Result<()> {
    let obj = obj_path(&args.output, recipe.word())?;
    let stem = obj.file_stem().and_then(|stem| stem.to_str()).context("the name of the OBJ file is not UTF-8")?;
    let model = recipe.make(values.count("triangles"));
    // All are written before any appears, the OBJ last: where it is, the others are.
    let texts = [
        (obj.with_extension("mtl"), model.mtl(stem)),
        (obj.with_extension("camera.toml"), model.camera(stem)),
        (obj.clone(), model.obj(stem)),
    ];
    let mut files = vec![];
    for (path, text) in &texts {
        let mut file = create_output(path)?;
        file.write_all(text.as_bytes())?;
        files.push(file);
    }
    files.into_iter().try_for_each(cli::Output::commit)?;
    args.common.remark(format!("{}: {} triangles", obj.display(), model.triangle_count()));
    Ok(())
}

/// The OBJ file that `output` means: itself by its ending, else one of the scene's name in a folder, made if need be.
fn obj_path(output: &Path, name: &str) -> anyhow::Result<PathBuf> {
    if output == Path::new("-") {
        return Err(usage("three files do not go to standard output; name a folder or an OBJ file"));
    }
    if output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj")) {
        return Ok(output.to_owned());
    }
    std::fs::create_dir_all(output).with_context(|| format!("cannot make the folder {}", output.display()))?;
    Ok(output.join(name).with_extension("obj"))
}
