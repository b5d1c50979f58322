//! What stands below a chart or table: the command that made it, its data, and the history of its streams.

use super::html::{data_uri, escaped};
use super::sheet::Sheet;
use std::fmt::Write as _;

/// The column that tells how rows were found: in full, sampled, thinned.
pub(super) const FOUND: &str = "found";
/// The column that tells by which commands the streams of rows came.
pub(super) const HISTORY: &str = "history";

/// The command that made a block.
pub(super) fn made_by(command: Option<&str>) -> String {
    command
        .map_or(String::new(), |command| format!("<p class=\"made\">Made by <code>{}</code></p>\n", escaped(command)))
}

/// The data of a block: these columns of its rows, shown and to be saved, and the histories of the rows.
pub(super) fn data(sheet: &Sheet, columns: &[usize], file_name: &str) -> String {
    let csv = as_csv(sheet, columns);
    let rows = sheet.rows.len();
    let mut html = format!(
        "<details><summary>Data: {rows} {}</summary>\n\
         <p><a download=\"{}\" href=\"{}\">Save as CSV</a></p>\n\
         <pre tabindex=\"0\">\n{}</pre>\n",
        if rows == 1 { "row" } else { "rows" },
        escaped(file_name),
        data_uri("text/csv", csv.as_bytes()),
        escaped(&csv)
    );
    let histories = histories(sheet);
    if !histories.is_empty() {
        html += "<p>The streams were made by</p>\n<ol class=\"history\">\n";
        for history in histories {
            let _ = writeln!(html, "<li><code>{}</code></li>", escaped(history));
        }
        html += "</ol>\n";
    }
    html + "</details>\n"
}

fn as_csv(sheet: &Sheet, columns: &[usize]) -> String {
    let mut writer = csv::Writer::from_writer(vec![]);
    let records = std::iter::once(&sheet.columns).chain(&sheet.rows);
    for record in records {
        // Into memory, with as many fields in each row: this does not fail.
        let _ = writer.write_record(columns.iter().map(|&column| &record[column]));
    }
    writer.into_inner().map_or(String::new(), |csv| String::from_utf8_lossy(&csv).into_owned())
}

/// The histories of the rows, each once.
fn histories(sheet: &Sheet) -> Vec<&str> {
    let Some(column) = sheet.find(HISTORY) else { return vec![] };
    let mut histories: Vec<&str> = vec![];
    for row in &sheet.rows {
        if !row[column].is_empty() && !histories.contains(&&*row[column]) {
            histories.push(&row[column]);
        }
    }
    histories
}
