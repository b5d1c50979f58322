//! What stands below a chart or table: its data, and the history of its streams.

use super::html::data_uri;
use crate::sheet::Sheet;
use minijinja::{Value, context};
use std::path::Path;

/// The column that tells how rows were found: in full, sampled, thinned.
pub(super) const FOUND: &str = "found";
/// The column that tells by which commands the streams of rows came.
pub(super) const HISTORY: &str = "history";

/// The data of a block: these columns of its rows, shown and to be saved under the name of the table, and the histories of
/// the rows.
pub(super) fn data(sheet: &Sheet, columns: &[usize], table: &str) -> Value {
    let csv = sheet.as_csv(columns);
    let file = Path::new(table).file_name().map_or("data.csv".into(), |name| name.to_string_lossy());
    context! {
        rows => sheet.rows.len(),
        file => &*file,
        address => data_uri("text/csv", csv.as_bytes()),
        csv,
        histories => histories(sheet),
    }
}

/// The histories of the rows, each once.
fn histories(sheet: &Sheet) -> Vec<String> {
    let Some(column) = sheet.find(HISTORY) else { return vec![] };
    let mut histories = vec![];
    for row in &sheet.rows {
        if !row[column].is_empty() && !histories.iter().any(|history| *history == row[column]) {
            histories.push(row[column].to_owned());
        }
    }
    histories
}
