//! A chart as a drawing of its own.

use super::{Args, bytes, fault};
use crate::cli::named;
use pm_report::chart::{Look, Plot, Selection};
use pm_report::sheet::Sheet;
use std::path::PathBuf;
use std::sync::Arc;

/// The chart of the tables, as SVG.
///
/// # Errors
/// If a table cannot be read or drawn.
pub(super) fn svg(args: &Args) -> anyhow::Result<String> {
    let (tables, references) = (sheets(&args.tables)?, sheets(&args.reference)?);
    let selection = Selection {
        x: args.x.clone().unwrap_or_default(),
        y: args.y.clone().unwrap_or_default(),
        by: args.by.clone(),
        error: args.error.clone(),
        only: args.only.clone(),
        x_scale: args.x_scale,
        y_scale: args.y_scale,
    };
    let mut plot = Plot::read(&selection, &tables, &references).map_err(|error| fault(&error))?;
    plot.x.label = args.x_label.clone().unwrap_or(plot.x.label);
    plot.y.label = args.y_label.clone().unwrap_or(plot.y.label);
    let look =
        Look { title: args.title.clone(), size: args.size, lines: !args.points, frontier: args.frontier, legend: true };
    Ok(plot.picture(&look))
}

fn sheets(paths: &[PathBuf]) -> anyhow::Result<Vec<Arc<Sheet>>> {
    let sheet = |path: &PathBuf| {
        let sheet = Sheet::parse(&named(path), &bytes(path)?).map_err(|error| fault(&error))?;
        Ok(Arc::new(sheet))
    };
    paths.iter().map(sheet).collect()
}
