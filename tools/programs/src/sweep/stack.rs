//! `pm-sweep stack`: tables with the same columns below one another.

use crate::cli::create_output;
use anyhow::Context as _;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;

#[derive(clap::Args)]
pub(super) struct Args {
    /// Tables with the same columns
    #[arg(required = true)]
    tables: Vec<PathBuf>,
    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let read = |path: &PathBuf| {
        let name = path.display().to_string();
        anyhow::Ok((name.clone(), fs::read(path).context(name)?))
    };
    let tables = args.tables.iter().map(read).collect::<anyhow::Result<Vec<_>>>()?;
    let stacked = pm_sweep::join::stack(tables)?;
    let mut output = create_output(&args.output)?;
    output.write_all(&stacked.to_csv())?;
    output.commit()
}
