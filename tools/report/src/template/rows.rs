//! Tables and their rows as templates know them.

use crate::ReportError;
use crate::expression::{cell, conditions, inner, is};
use crate::sheet::Sheet;
use minijinja::value::{Enumerator, Kwargs, Object, ObjectRepr, Rest, from_args};
use minijinja::{Error, ErrorKind, State, Value};
use std::path::Path;
use std::sync::Arc;

/// The tables, by number or by the name of their file.
#[derive(Debug)]
pub(super) struct Tables(pub(super) Vec<Arc<Sheet>>);

/// The rows of a table.
#[derive(Debug)]
struct Rows(Arc<Sheet>);

/// A row of a table.
#[derive(Debug)]
struct Row(Arc<Sheet>, usize);

/// What a table is called: its file's name without folder and ending.
fn stem(sheet: &Sheet) -> &str {
    Path::new(sheet.name()).file_stem().and_then(|stem| stem.to_str()).unwrap_or(sheet.name())
}

impl Object for Tables {
    fn repr(self: &Arc<Self>) -> ObjectRepr {
        ObjectRepr::Seq
    }

    fn get_value(self: &Arc<Self>, key: &Value) -> Option<Value> {
        let sheet = match (key.as_usize(), key.as_str()) {
            (Some(at), _) => self.0.get(at)?,
            (None, Some(name)) => match self.0.iter().find(|sheet| stem(sheet) == name) {
                Some(sheet) => sheet,
                None => return Some(inner(ReportError::asked(format!("a table {name}.csv is wanted"))).into()),
            },
            (None, None) => return None,
        };
        Some(Value::from_object(Rows(Arc::clone(sheet))))
    }

    fn enumerate(self: &Arc<Self>) -> Enumerator {
        Enumerator::Seq(self.0.len())
    }
}

impl Object for Rows {
    fn repr(self: &Arc<Self>) -> ObjectRepr {
        ObjectRepr::Seq
    }

    fn get_value(self: &Arc<Self>, key: &Value) -> Option<Value> {
        match (key.as_usize(), key.as_str()) {
            (Some(at), _) if at < self.0.rows().len() => Some(Value::from_object(Row(Arc::clone(&self.0), at))),
            (None, Some("name")) => Some(Value::from(stem(&self.0))),
            _ => None,
        }
    }

    fn enumerate(self: &Arc<Self>) -> Enumerator {
        Enumerator::Seq(self.0.rows().len())
    }

    fn call_method(self: &Arc<Self>, _: &mut State<'_, '_>, method: &str, args: &[Value]) -> Result<Value, Error> {
        if method != "find" {
            return Err(Error::from(ErrorKind::UnknownMethod));
        }
        let (chosen,): (Kwargs,) = from_args(args)?;
        let conditions = conditions(&chosen)?;
        let at = |(column, value)| Ok((self.0.column(column).map_err(inner)?, value));
        let wanted = conditions.iter().map(|(column, value)| at((column, value))).collect::<Result<Vec<_>, Error>>()?;
        let found = self.0.rows().iter().position(|row| wanted.iter().all(|&(at, value)| is(&row[at], value)));
        Ok(found.map_or(Value::UNDEFINED, |at| Value::from_object(Row(Arc::clone(&self.0), at))))
    }
}

impl Object for Row {
    fn get_value(self: &Arc<Self>, key: &Value) -> Option<Value> {
        let column = self.0.find(key.as_str()?)?;
        Some(cell(&self.0.rows()[self.1][column]))
    }

    fn enumerate(self: &Arc<Self>) -> Enumerator {
        Enumerator::Values(self.0.columns().iter().map(|column| Value::from(&**column)).collect())
    }

    fn call_method(self: &Arc<Self>, _: &mut State<'_, '_>, method: &str, args: &[Value]) -> Result<Value, Error> {
        if method != "csv" {
            return Err(Error::from(ErrorKind::UnknownMethod));
        }
        let (columns,): (Rest<String>,) = from_args(args)?;
        let columns = columns.iter().map(|column| self.0.column(column).map_err(inner));
        let columns = columns.collect::<Result<Vec<usize>, Error>>()?;
        Ok(Value::from(self.0.row_as_csv(self.1, &columns)))
    }
}
