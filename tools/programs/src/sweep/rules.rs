//! `pm-sweep rules`: tables become rules for make.

use super::tables::{self, Vocabulary, asked_wrongly};
use super::{derive, fingerprint};
use crate::cli::{create_output, usage};
use pm_sweep::Sweep;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub(super) struct Args {
    /// Tables of experiments
    tables: Vec<PathBuf>,
    /// One more table, and its rows are those that `make sweep` makes
    #[arg(long, value_name = "FILE")]
    own: Option<PathBuf>,
    /// Names that no --own table may have: make has other targets of these names
    #[arg(long, value_name = "NAMES", value_delimiter = ' ')]
    taken: Vec<String>,
    /// A table of claims: what files of rows it needs is the variable CLAIMED.NAME; may be repeated
    #[arg(long, value_name = "FILE")]
    claims: Vec<PathBuf>,
    #[command(flatten)]
    vocabulary: Vocabulary,
    /// File to write; it stays as it is where nothing changes. `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let words = args.vocabulary.read()?;
    let mut sweeps: Vec<Sweep> = vec![];
    // A table that is there anyway may be one's own as well.
    let same =
        |path: &PathBuf| args.own.as_ref().is_some_and(|own| fs::canonicalize(own).ok() == fs::canonicalize(path).ok());
    for path in args.tables.iter().filter(|path| !same(path)).chain(&args.own) {
        let sweep = tables::sweep(path, &words)?;
        if let Some(other) = sweeps.iter().find(|other| other.name == sweep.name) {
            return Err(taken(&sweep, &format!("that is {}", other.file)));
        }
        sweeps.push(sweep);
    }
    let own = args.own.as_ref().and_then(|_| sweeps.last());
    if let Some(own) = own.filter(|own| args.taken.contains(&own.name) && !args.tables.iter().any(same)) {
        return Err(taken(own, "other targets of make are called so"));
    }
    let mut text = format!("# Made by pm-sweep; scripts/sweep.mk has the recipes.\n{}", fingerprint::variables());
    if let Some(own) = own {
        text += &format!("OWN := {}\n", own.joined());
    }
    for claims in &args.claims {
        let name = claims.file_stem().unwrap_or_default().display();
        text += &format!("CLAIMED.{name} := {}\n", derive::files_of_claims(claims)?.join(" "));
    }
    text += &pm_sweep::rules::rules(&sweeps, &args.vocabulary.words.display().to_string()).map_err(asked_wrongly)?;
    if is_there(&args.output, text.as_bytes()) {
        return Ok(());
    }
    let mut output = create_output(&args.output)?;
    output.write_all(text.as_bytes())?;
    output.commit()
}

fn taken(sweep: &Sweep, by: &str) -> anyhow::Error {
    usage(format!("{}:1: there is a `{}` already, {by}: give the table another name", sweep.file, sweep.name))
}

/// Whether a file holds this already.
fn is_there(path: &Path, bytes: &[u8]) -> bool {
    path != Path::new("-") && fs::read(path).is_ok_and(|old| old == bytes)
}
