//! Tables of experiments, read from files.

use crate::cli::usage;
use anyhow::Context as _;
use pm_sweep::{Sweep, Table, TableError, Words};
use std::fs;
use std::path::{Path, PathBuf};

/// What the words of tables mean.
#[derive(clap::Args)]
pub(super) struct Vocabulary {
    /// Vocabularies: what the words of some labels add to the stages
    #[arg(long, value_name = "FILE", default_value = "scripts/words.csv")]
    pub(super) words: PathBuf,
}

impl Vocabulary {
    pub(super) fn read(&self) -> anyhow::Result<Words> {
        Words::read(&self.words.display().to_string(), &read(&self.words)?, &variable).map_err(asked_wrongly)
    }
}

/// The points of the table in a file.
pub(super) fn sweep(path: &Path, words: &Words) -> anyhow::Result<Sweep> {
    let file = path.display().to_string();
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let wrong = |what: String| asked_wrongly(TableError { file: file.clone(), line: 1, what });
    if let Some(letter) = name.chars().find(|&c| !(c.is_alphanumeric() || "._-+@".contains(c))) {
        return Err(wrong(format!(
            "`{name}` shall name what make makes, and make would misread `{letter}`: rename the table"
        )));
    }
    let table = Table::read(&file, &read(path)?).map_err(asked_wrongly)?;
    Sweep::new(&name, &table, words, &variable).map_err(asked_wrongly)
}

pub(super) fn asked_wrongly(error: TableError) -> anyhow::Error {
    usage(error.to_string())
}

/// The value of a variable that make exports.
fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok()
}

fn read(path: &Path) -> anyhow::Result<String> {
    fs::read_to_string(path).with_context(|| path.display().to_string())
}
