//! `pm-sweep place`: a scene in another unit and at another place.

use crate::cli::create_output;
use anyhow::Context as _;
use std::io::Write as _;
use std::path::PathBuf;

#[derive(clap::Args)]
pub(super) struct Args {
    /// An OBJ file, or a scene's camera file
    file: PathBuf,
    /// What every position is multiplied by
    #[arg(long, default_value = "1")]
    scale: f64,
    /// What is added to every coordinate then
    #[arg(long, default_value = "0", allow_negative_numbers = true)]
    offset: f64,
    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let text = std::fs::read_to_string(&args.file).with_context(|| args.file.display().to_string())?;
    let mut output = create_output(&args.output)?;
    output.write_all(pm_sweep::placed(&text, args.scale, args.offset).as_bytes())?;
    output.commit()
}
