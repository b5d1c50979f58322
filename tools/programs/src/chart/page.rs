//! Pages: as a description says, or of one chart.

use super::{Args, bytes, fault};
use crate::cli::{self, Typed, named, usage};
use anyhow::anyhow;
use pm_formats::as_commands;
use pm_report::ReportError;
use pm_report::page::{ChartBlock, Description};
use pm_report::sheet::{Sheets, Values};
use std::collections::BTreeMap;
use std::path::Path;

/// The page that a description asks for.
///
/// # Errors
/// If the description cannot be read, or asks for what is not there.
pub(super) fn described(path: &Path, anyway: bool) -> anyhow::Result<String> {
    let name = named(path);
    let text = String::from_utf8(bytes(path)?).map_err(|_| anyhow!("{name}: it is not UTF-8"))?;
    let page = |error: ReportError| match error.asked_wrongly() {
        true => usage(format!("{name}, {error}")),
        false => anyhow!("{name}, {error}"),
    };
    let description = Description::parse(&text).map_err(page)?;
    let own = path.parent().filter(|_| path != Path::new("-")).unwrap_or(Path::new(""));
    let sheets = Sheets::of_folder(&own.join(&description.folder));
    let here = if own.as_os_str().is_empty() { Path::new(".") } else { own };
    let sheets = if anyway { sheets } else { sheets.within(here) };
    description.html(&sheets, &generator()).map_err(page)
}

/// A page with the one chart and its table.
///
/// # Errors
/// If a table cannot be read or drawn.
pub(super) fn of_chart(args: &Args, typed: &Typed) -> anyhow::Result<String> {
    let sheets = Sheets::default();
    let mut names = vec![];
    for path in args.tables.iter().chain(&args.reference) {
        sheets.add(&named(path), &bytes(path)?).map_err(|error| fault(&error))?;
        names.push(named(path));
    }
    let reference = names.split_off(args.tables.len());
    let mut only: BTreeMap<String, Vec<String>> = BTreeMap::new();
    args.only.iter().for_each(|(column, value)| only.entry(column.clone()).or_default().push(value.clone()));
    let chart = ChartBlock {
        title: args.title.clone(),
        command: Some(as_commands(&[typed.step(None)]).trim_end().to_owned()),
        tables: names,
        reference,
        x: args.x.clone().unwrap_or_default(),
        y: args.y.clone().unwrap_or_default(),
        by: args.by.clone(),
        error: args.error.clone(),
        only: only.into_iter().map(|(column, values)| (column, Values::Any(values))).collect(),
        x_scale: args.x_scale,
        y_scale: args.y_scale,
        points: args.points,
        frontier: args.frontier,
        x_label: args.x_label.clone(),
        y_label: args.y_label.clone(),
        ..ChartBlock::default()
    };
    Description::of_chart(chart).html(&sheets, &generator()).map_err(|error| fault(&error))
}

/// What a page says of the program that wrote it.
fn generator() -> String {
    format!("pm-chart {}", cli::VERSION)
}
