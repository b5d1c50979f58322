//! Rows of a sheet by what their columns hold, for expressions.

use super::place::{Place, Places};
use super::{inner, number};
use crate::ReportError;
use crate::sheet::Sheet;
use minijinja::Value;
use minijinja::value::{Kwargs, Object};
use std::fmt::Write as _;
use std::sync::Arc;

/// The rows that have the values asked for; what they do not agree in cannot be asked of them.
#[derive(Debug)]
pub(super) struct Row {
    /// As it was asked for.
    asked: String,
    /// The same in words: ` with order=scanline, ways=1`.
    told: String,
    sheet: Arc<Sheet>,
    rows: Vec<usize>,
    places: Places,
}

/// The values that columns are to have.
pub(super) fn conditions(chosen: &Kwargs) -> Result<Vec<(String, Value)>, minijinja::Error> {
    chosen.args().map(|name| Ok((name.to_owned(), chosen.get(name)?))).collect()
}

/// Whether a field is this value: the same number, or the same word.
fn is(field: &str, value: &Value) -> bool {
    match f64::try_from(value.clone()).ok().filter(|_| value.is_number()) {
        Some(wanted) => number(field) == Some(wanted),
        None => value.as_str() == Some(field),
    }
}

/// A field as expressions know it: a whole number, a number, or a word.
fn cell(field: &str) -> Value {
    match (field.parse::<i64>(), number(field)) {
        (Ok(whole), _) => Value::from(whole),
        (_, Some(number)) => Value::from(number),
        _ => Value::from(field),
    }
}

impl Row {
    /// The rows with these values, of which there has to be one; `call` is how they were asked for, without its end.
    pub(super) fn choose(
        sheet: Arc<Sheet>,
        call: String,
        conditions: &[(String, Value)],
        places: Places,
    ) -> Result<Self, ReportError> {
        let (mut asked, mut told) = (call, String::new());
        let mut rows: Vec<usize> = (0..sheet.rows().len()).collect();
        for (column, value) in conditions {
            let at = sheet.column(column)?;
            rows.retain(|&row| is(&sheet.rows()[row][at], value));
            let _ = write!(told, "{}{column}={value}", if told.is_empty() { " with " } else { ", " });
            let _ = write!(asked, ", {column}={value:?}");
        }
        if rows.is_empty() {
            return Err(ReportError::asked(format!("{} has no row{told}", sheet.name())));
        }
        Ok(Self { asked: asked + ")", told, sheet, rows, places })
    }

    fn field(&self, column: &str) -> Result<Value, ReportError> {
        let at = self.sheet.column(column)?;
        let field = |row: &usize| &self.sheet.rows()[*row][at];
        let first = &self.rows[0];
        if self.rows.iter().any(|row| field(row) != field(first)) {
            let (file, many, told) = (self.sheet.name(), self.rows.len(), &self.told);
            return Err(ReportError::asked(format!(
                "{file} has {many} rows{told}, and they differ in {column}: name a column that tells them apart"
            )));
        }
        let place = Place { asked: self.asked.clone(), sheet: Arc::clone(&self.sheet), row: *first, column: at };
        let value = cell(place.field());
        self.places.add(place);
        Ok(value)
    }
}

impl Object for Row {
    fn get_value(self: &Arc<Self>, key: &Value) -> Option<Value> {
        let column = key.as_str()?;
        Some(self.field(column).unwrap_or_else(|error| inner(error).into()))
    }
}
