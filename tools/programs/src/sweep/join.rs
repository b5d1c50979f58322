//! `pm-sweep join`: the rows of a table's points as one table.

use super::tables::{self, Vocabulary};
use crate::cli::create_output;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;

#[derive(clap::Args)]
pub(super) struct Args {
    /// The table of experiments
    table: PathBuf,
    #[command(flatten)]
    vocabulary: Vocabulary,
    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let sweep = tables::sweep(&args.table, &args.vocabulary.read()?)?;
    let joined = pm_sweep::join::join(&sweep, |file| fs::read(file).ok())?;
    let mut output = create_output(&args.output)?;
    output.write_all(&joined.to_csv())?;
    output.commit()
}
