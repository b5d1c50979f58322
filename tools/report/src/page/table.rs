//! Tables of a page: their rows, chosen, sorted and joined with others.

mod columns;

use super::below::{self, HISTORY};
use super::{Join, TableBlock};
use crate::ReportError;
use crate::sheet::{Sheet, Sheets};
use csv::StringRecord;
use minijinja::{Value, context};

/// What the template of a table needs; `title` is text, `text` HTML.
///
/// # Errors
/// If a file, column or row is not there, or a format is asked of what is not a number.
pub(super) fn block(
    block: &TableBlock,
    (title, text): (String, Value),
    command: Option<&str>,
    sheets: &Sheets,
) -> Result<Value, ReportError> {
    let sheet = rows(block, sheets)?;
    let columns = columns::shown(block, &sheet)?;
    let fields = |row: &StringRecord| columns.iter().map(|column| column.field(row, &sheet)).collect();
    let rows = sheet.rows.iter().map(fields).collect::<Result<Vec<Vec<String>>, ReportError>>()?;
    let all: Vec<usize> = (0..sheet.columns.len()).filter(|&at| sheet.columns[at] != HISTORY).collect();
    Ok(context! {
        template => "table.html",
        id => block.id.as_deref(),
        title,
        text,
        folded => block.folded,
        columns => columns.iter().map(columns::Column::head).collect::<Vec<_>>(),
        rows,
        command,
        data => below::data(&sheet, &all, &block.tables[0]),
    })
}

/// The rows that are shown, with the columns of the joined tables.
fn rows(block: &TableBlock, sheets: &Sheets) -> Result<Sheet, ReportError> {
    let (first, others) =
        block.tables.split_first().ok_or_else(|| ReportError::asked("a table has at least one of `tables`"))?;
    let mut sheet = (*sheets.get(first)?).clone();
    for other in others {
        sheet.append(&*sheets.get(other)?);
    }
    sheet.keep(&block.only)?;
    for join in &block.join {
        look_up(&mut sheet, join, sheets)?;
    }
    sheet.sort(&block.sort)?;
    if sheet.rows.is_empty() {
        return Err(ReportError::asked(format!("{}: the table has no rows", sheet.name)));
    }
    Ok(sheet)
}

/// Adds the columns of another table from the row that has the same values in the columns to look up by; where there is no
/// such row they are empty.
fn look_up(sheet: &mut Sheet, join: &Join, sheets: &Sheets) -> Result<(), ReportError> {
    let other = sheets.get(&join.table)?;
    let pairs = join.on.iter().map(|name| Ok((sheet.column(name)?, other.column(name)?)));
    let pairs = pairs.collect::<Result<Vec<_>, ReportError>>()?;
    let mut matches = vec![];
    for row in &sheet.rows {
        let mut fits = other.rows.iter().filter(|theirs| pairs.iter().all(|&(a, b)| row[a] == theirs[b]));
        let first = fits.next();
        if first.is_some() && fits.next().is_some() {
            let values: Vec<&str> = pairs.iter().map(|&(a, _)| &row[a]).collect();
            return Err(ReportError::asked(format!(
                "{} has several rows with `{}` in {}; join on more columns",
                join.table,
                values.join("`, `"),
                join.on.join(", ")
            )));
        }
        matches.push(first);
    }
    for (at, column) in other.columns.iter().enumerate() {
        let fields = matches.iter().map(|row| row.map_or(String::new(), |row| row[at].to_owned())).collect();
        sheet.add_column(&format!("{}.{column}", join.name), fields);
    }
    Ok(())
}

#[cfg(test)]
mod tests;
