//! `pm-sweep derive`: tables and judgements made of results.

use crate::cli::{create_output, usage};
use anyhow::{Context as _, bail};
use pm_report::sheet::Sheets;
use pm_verdicts::{Asked, Table, derivations};
use std::collections::BTreeMap;
use std::io::{Read as _, Write as _};
use std::path::PathBuf;

#[derive(clap::Args)]
pub(super) struct Args {
    /// What to derive: see --list
    #[arg(required_unless_present = "list")]
    what: Option<String>,
    /// The tables that it is made of; `-` is standard input
    tables: Vec<PathBuf>,
    /// List what can be derived
    #[arg(long)]
    list: bool,
    /// A setting, such as budget=35; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    with: Vec<String>,
    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

pub(super) fn run(args: &Args) -> anyhow::Result<()> {
    let derivations = derivations();
    let mut output = create_output(&args.output)?;
    let Some(what) = args.what.as_deref().filter(|_| !args.list) else {
        output.write_all(derivations.table().as_bytes())?;
        return output.commit();
    };
    let derivation = derivations.find(what).map_err(|error| usage(error.to_string()))?;
    let mut settings = BTreeMap::new();
    for setting in &args.with {
        let Some((name, value)) = setting.split_once('=') else {
            return Err(usage(format!("--with {setting}: NAME=VALUE is expected")));
        };
        if !derivation.settings.contains(&name) {
            let known = match derivation.settings {
                [] => "it takes none".to_owned(),
                known => format!("it takes {}", known.join(", ")),
            };
            return Err(usage(format!("--with {setting}: {what} has no such setting; {known}")));
        }
        settings.insert(name.to_owned(), value.to_owned());
    }
    let tables = args.tables.iter().map(read).collect::<anyhow::Result<Vec<_>>>()?;
    let asked = Asked { tables: &tables, settings: &settings, results: &Sheets::default() };
    let derived = (derivation.derive)(&asked).with_context(|| what.to_owned())?;
    // A judgement is shown, whatever it says; but it makes no file of what does not hold.
    output.write_all(derived.text.as_bytes())?;
    let Some(fault) = derived.fault else { return output.commit() };
    if args.output.as_os_str() == "-" {
        output.commit()?;
    }
    bail!("{fault}");
}

/// The files of rows that claims need.
pub(super) fn files_of_claims(claims: &PathBuf) -> anyhow::Result<Vec<String>> {
    let derivation = derivations().find("claims").map_err(|error| usage(error.to_string()))?;
    let settings = BTreeMap::from([("list".to_owned(), String::new())]);
    let asked = Asked { tables: &[read(claims)?], settings: &settings, results: &Sheets::default() };
    let listed = (derivation.derive)(&asked)?;
    Ok(listed.text.lines().map(str::to_owned).collect())
}

fn read(path: &PathBuf) -> anyhow::Result<Table> {
    let name = path.display().to_string();
    let text = if name == "-" {
        let mut text = String::new();
        std::io::stdin().read_to_string(&mut text).context("standard input")?;
        text
    } else {
        std::fs::read_to_string(path).with_context(|| name.clone())?
    };
    Ok(Table::read(&name, text)?)
}
