//! The columns of a table on a page: what is shown, and how it is written.

use crate::ReportError;
use crate::page::below::{FOUND, HISTORY};
use crate::page::{NumberFormat, Shown, ShownColumn, TableBlock};
use crate::sheet::{Sheet, number};
use csv::StringRecord;
use minijinja::{Value, context};

/// A column that is shown: how its fields are found and written.
pub(super) struct Column {
    heading: String,
    content: Content,
    error: Option<usize>,
    format: Option<NumberFormat>,
    /// To the right, as numbers are?
    of_numbers: bool,
    /// Text of several lines, which needs room?
    long: bool,
}

/// What stands in a column.
#[derive(Clone, Copy)]
enum Content {
    Field(usize),
    Ratio(usize, usize),
}

/// Letters of a field from which on its column is given room.
const LONG: usize = 60;

/// What stands where there is nothing.
const NOTHING: &str = "–";

/// The columns to show; the one that tells how a row was found always is.
pub(super) fn shown(block: &TableBlock, sheet: &Sheet) -> Result<Vec<Column>, ReportError> {
    let mut shown = block.columns.clone();
    if shown.is_empty() {
        let all = sheet.columns.iter().filter(|name| *name != HISTORY);
        shown = all.map(|name| Shown::Plain(name.clone())).collect();
    }
    let mut columns = shown.iter().map(|shown| column(shown, sheet)).collect::<Result<Vec<_>, _>>()?;
    if let Some(found) = sheet.find(FOUND)
        && !columns.iter().any(|column| matches!(column.content, Content::Field(at) if at == found))
    {
        columns.push(column(&Shown::Plain(FOUND.to_owned()), sheet)?);
    }
    Ok(columns)
}

fn column(shown: &Shown, sheet: &Sheet) -> Result<Column, ReportError> {
    let full = match shown {
        Shown::Plain(name) => &ShownColumn { column: Some(name.clone()), ..ShownColumn::default() },
        Shown::Full(full) => full,
    };
    let (content, name) = match (&full.column, &full.ratio) {
        (Some(name), None) => (Content::Field(sheet.column(name)?), name.replace('_', " ")),
        (None, Some([a, b])) => (Content::Ratio(sheet.column(a)?, sheet.column(b)?), format!("{a} / {b}")),
        _ => return Err(ReportError::asked("of `column` and `ratio`, a column of a table has one")),
    };
    let format =
        full.format.as_deref().map(str::parse).transpose().map_err(|error: String| ReportError::asked(error))?;
    let of_numbers = match content {
        Content::Ratio(..) => true,
        Content::Field(at) => {
            let mut fields = sheet.rows.iter().map(|row| &row[at]).filter(|field| !field.is_empty()).peekable();
            format.is_some() || (fields.peek().is_some() && fields.all(|field| number(field).is_some()))
        }
    };
    let error = full.error.as_deref().map(|name| sheet.column(name)).transpose()?;
    let long = matches!(content, Content::Field(at) if sheet.rows.iter().any(|row| row[at].chars().count() >= LONG));
    Ok(Column { heading: full.heading.clone().unwrap_or(name), content, error, format, of_numbers, long })
}

impl Column {
    /// What the template needs for the head.
    pub(super) fn head(&self) -> Value {
        context! { heading => &*self.heading, of_numbers => self.of_numbers, long => self.long }
    }

    /// What stands in a row.
    ///
    /// # Errors
    /// If half the width of an interval is not a number.
    pub(super) fn field(&self, row: &StringRecord, sheet: &Sheet) -> Result<String, ReportError> {
        let write = |value: f64| self.format.map_or_else(|| value.to_string(), |format| format.write(value));
        let at = match self.content {
            Content::Field(at) => at,
            Content::Ratio(a, b) => {
                let ratio = number(&row[a]).zip(number(&row[b])).map(|(a, b)| a / b);
                return Ok(ratio.filter(|ratio| ratio.is_finite()).map_or(NOTHING.to_owned(), write));
            }
        };
        let field = &row[at];
        if field.is_empty() {
            return Ok(NOTHING.to_owned());
        }
        let mut text = match (self.format, number(field)) {
            (Some(_), Some(value)) => write(value),
            // As it is: a number without a format, or a word, such as `full` among numbers of ways.
            _ => field.to_owned(),
        };
        if let Some(error) = self.error.map(|at| &row[at]).filter(|error| !error.is_empty()) {
            let half = number(error).ok_or_else(|| {
                ReportError::read(format!("{}: `{error}` as half the width of an interval is not a number", sheet.name))
            })?;
            // What is known in full has no interval.
            if half > 0.0 {
                text += &format!(" ± {}", write(half));
            }
        }
        Ok(text)
    }
}
