//! `pm-sweep row`: what a point printed is its row, if it is whole.

use anyhow::Context as _;
use pm_sweep::rows::Rows;
use std::fs;
use std::path::PathBuf;

#[derive(clap::Args)]
pub(super) struct Args {
    /// What was printed
    printed: PathBuf,
    /// The file that it becomes
    output: PathBuf,
}

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let (printed, output) = (args.printed.display().to_string(), args.output.display().to_string());
    let bytes = fs::read(&args.printed).with_context(|| printed)?;
    Rows::read(&output, &bytes)?;
    fs::rename(&args.printed, &args.output).with_context(|| output)
}
