//! `pm-chart`: draws charts of tables, and puts charts, tables, pictures and text on a page.

mod args;
mod drawing;
mod page;

pub use args::Args;

use crate::cli::{Typed, named, open_bytes, usage};
use anyhow::{Context as _, anyhow};
use pm_report::ReportError;
use std::io::{Read as _, Write as _};
use std::path::Path;

/// Does what was asked.
///
/// # Errors
/// If it was asked wrongly, a table cannot be read or drawn, or the output cannot be written.
pub fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    check_ending(&args)?;
    // A page excludes what a chart needs, so that the parser cannot tell.
    if args.anyway && args.page.is_none() {
        return Err(usage("--anyway is for --page: a chart reads what it is given"));
    }
    let text = match &args.page {
        Some(path) => page::described(path, args.anyway)?,
        None if args.output.output.as_ref().is_some_and(|path| path.extension().is_some_and(|e| e == "html")) => {
            page::of_chart(&args, typed)?
        }
        None => drawing::svg(&args)?,
    };
    let mut output = args.output.create()?;
    output.write_all(text.as_bytes())?;
    output.commit()
}

/// Refuses a file whose name promises something else than what is in it.
fn check_ending(args: &Args) -> anyhow::Result<()> {
    let Some(path) = &args.output.output else { return Ok(()) };
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let (may, what) = match &args.page {
        Some(_) => (&["html", "htm"][..], "a page is HTML: name it *.html"),
        None => (&["svg", "html"][..], "a chart is SVG, or a page with it: name it *.svg or *.html"),
    };
    match ending.filter(|ending| !may.contains(&&**ending)) {
        Some(_) if path.exists() && !path.is_file() => Ok(()),
        Some(_) => Err(usage(format!("{}: {what}", path.display()))),
        None => Ok(()),
    }
}

/// An error of a report as one of the program; what the table holds is not the asker's fault, what is asked for is.
fn fault(error: &ReportError) -> anyhow::Error {
    match error.asked_wrongly() {
        true => usage(error.to_string()),
        false => anyhow!("{error}"),
    }
}

/// All that a file holds.
fn bytes(path: &Path) -> anyhow::Result<Vec<u8>> {
    let mut bytes = vec![];
    open_bytes(path)?.read_to_end(&mut bytes).with_context(|| named(path))?;
    Ok(bytes)
}
