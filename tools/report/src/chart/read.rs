//! From tables to series: which columns, which rows.

use super::{Axis, Plot, Point, Selection, Series};
use crate::ReportError;
use crate::sheet::{Sheet, number};
use std::path::Path;
use std::sync::Arc;

/// A row that is drawn, x as it is written.
struct Row {
    series: String,
    x: String,
    y: f64,
    error: Option<f64>,
    table: usize,
    line: u64,
}

impl Plot {
    /// Makes a plot of tables, and of tables with points to compare with.
    ///
    /// Rows without a value in x or y (an empty field) are passed over.
    ///
    /// # Errors
    /// If a column is not there, a field is not a number, no row is left, or a value has no place on its axis.
    pub fn read(selection: &Selection, tables: &[Arc<Sheet>], references: &[Arc<Sheet>]) -> Result<Self, ReportError> {
        let all: Vec<&Sheet> = tables.iter().chain(references).map(|sheet| &**sheet).collect();
        let ours = tables.len();
        let mut rows = vec![];
        for (table, sheet) in all.iter().enumerate() {
            read_table(selection, (table, table >= ours), sheet, &mut rows)?;
        }
        if rows.iter().all(|row| row.table >= ours) {
            let filtered = if selection.only.is_empty() { "" } else { " and fits --only" };
            let Selection { x, y, .. } = selection;
            return Err(ReportError::asked(format!("no row has a value in both {x} and {y}{filtered}")));
        }
        let (xs, words) = across(selection, &rows, ours, &all)?;
        let of_words = !words.is_empty();
        let x = Axis::fit(&selection.x, selection.x_scale, words, xs.iter().copied())
            .map_err(|value| not_positive(value, &selection.x))?;
        let y = Axis::fit(&selection.y, selection.y_scale, vec![], rows.iter().map(|row| row.y))
            .map_err(|value| not_positive(value, &selection.y))?;
        let (mut series, mut reference) = (vec![], vec![]);
        for (row, x) in rows.into_iter().zip(xs) {
            let side = if row.table < ours { &mut series } else { &mut reference };
            let point = Point { x, y: row.y, error: row.error };
            match side.iter_mut().find(|series: &&mut Series| series.name == row.series) {
                Some(known) => known.points.push(point),
                None => side.push(Series { name: row.series, points: vec![point] }),
            }
        }
        // What is compared with a series of ours says whose it is: `hilbert (paper)`.
        if let Some(whose) = references.first().map(|sheet| stem(sheet.name())) {
            let whose = whose.split('-').next().unwrap_or_default();
            for other in &mut reference {
                if series.iter().any(|ours| ours.name == other.name) {
                    other.name = format!("{} ({whose})", other.name);
                }
            }
        }
        if !of_words {
            // Lines go from left to right, in whatever order the rows came.
            let all = series.iter_mut().chain(&mut reference);
            all.for_each(|series| series.points.sort_by(|a, b| a.x.total_cmp(&b.x)));
        }
        Ok(Self { x, y, series, reference, whole: None })
    }
}

/// Where the rows lie across, and the words of the axis, if it is one of words: it is as soon as one of our own values is a
/// word.
fn across(
    selection: &Selection,
    rows: &[Row],
    ours: usize,
    sheets: &[&Sheet],
) -> Result<(Vec<f64>, Vec<String>), ReportError> {
    let mut words: Vec<String> = vec![];
    if rows.iter().any(|row| row.table < ours && number(&row.x).is_none()) {
        let place = |row: &Row| {
            let known = words.iter().position(|word| *word == row.x);
            known.unwrap_or_else(|| {
                words.push(row.x.clone());
                words.len() - 1
            }) as f64
        };
        return Ok((rows.iter().map(place).collect(), words));
    }
    let place =
        |row: &Row| number(&row.x).ok_or_else(|| wrong(sheets[row.table].name(), row.line, &row.x, &selection.x));
    Ok((rows.iter().map(place).collect::<Result<_, _>>()?, words))
}

fn wrong(table: &str, line: u64, text: &str, column: &str) -> ReportError {
    ReportError::read(format!("{table}, line {line}: `{text}` in column {column} is not a number"))
}

fn not_positive(value: f64, column: &str) -> ReportError {
    ReportError::asked(format!(
        "{value} in column {column} has no place on a logarithmic axis; choose `linear`, or leave it out by --only"
    ))
}

fn read_table(
    selection: &Selection,
    (table, is_reference): (usize, bool),
    sheet: &Sheet,
    rows: &mut Vec<Row>,
) -> Result<(), ReportError> {
    let (x, y) = (sheet.column(&selection.x)?, sheet.column(&selection.y)?);
    // What is compared with need not have all columns that ours have.
    let known = |wanted: &str| !is_reference || sheet.find(wanted).is_some();
    let error = selection.error.as_deref().filter(|wanted| known(wanted));
    let error = error.map(|wanted| sheet.column(wanted)).transpose()?;
    let by = selection.by.iter().filter(|wanted| known(wanted)).map(|wanted| sheet.column(wanted));
    let by = by.collect::<Result<Vec<_>, _>>()?;
    let only = selection.only.iter().filter(|(wanted, _)| known(wanted));
    let only = only.map(|(wanted, value)| Ok((sheet.column(wanted)?, value)));
    let only = only.collect::<Result<Vec<_>, ReportError>>()?;

    for (at, row) in sheet.rows().iter().enumerate() {
        let fits = |wanted: usize| only.iter().any(|&(column, value)| column == wanted && row[column] == **value);
        if row[x].is_empty() || row[y].is_empty() || !only.iter().all(|&(column, _)| fits(column)) {
            continue;
        }
        let line = sheet.line(at);
        let name = |column: usize| &sheet.columns()[column];
        let value =
            |column: usize| number(&row[column]).ok_or_else(|| wrong(sheet.name(), line, &row[column], name(column)));
        let series = by.iter().map(|&column| &row[column]).filter(|part| !part.is_empty()).collect::<Vec<_>>();
        rows.push(Row {
            series: if series.is_empty() { stem(sheet.name()) } else { series.join(", ") },
            x: row[x].to_owned(),
            y: value(y)?,
            error: error.filter(|&column| !row[column].is_empty()).map(value).transpose()?,
            table,
            line,
        });
    }
    Ok(())
}

/// What a table is called in the legend: a file's name without folder and ending.
fn stem(name: &str) -> String {
    Path::new(name).file_stem().map_or_else(|| name.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests;
