//! Rows under names, as other programs print them.

use crate::VerdictError;
use crate::derivation::fail;
use std::collections::HashMap;

/// A table, and what its file is called.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// The file's name, as it was given.
    pub file: String,
    /// The text it was read from.
    pub text: String,
    names: HashMap<String, usize>,
    rows: Vec<Vec<String>>,
}

/// A row of a table.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    table: &'a Table,
    cells: &'a [String],
}

impl Table {
    /// Reads CSV, or cells between tabs; lines that begin with `#` are remarks. An empty text has no names and no rows.
    ///
    /// # Errors
    /// If it is no such text.
    pub fn read(file: &str, text: String) -> Result<Self, VerdictError> {
        let first = text.lines().find(|line| !line.starts_with('#')).unwrap_or_default();
        let delimiter = if first.contains('\t') { b'\t' } else { b',' };
        let mut reader = csv::ReaderBuilder::new();
        reader.has_headers(false).flexible(true).comment(Some(b'#')).delimiter(delimiter);
        let mut rows = vec![];
        for record in reader.from_reader(text.as_bytes()).records() {
            match record {
                Ok(record) => rows.push(record.iter().map(str::to_owned).collect::<Vec<_>>()),
                Err(error) => return fail(format!("{file}: {error}")),
            }
        }
        let names = if rows.is_empty() { vec![] } else { rows.remove(0) };
        let names = names.into_iter().enumerate().map(|(at, name)| (name, at)).collect();
        Ok(Self { file: file.to_owned(), text, names, rows })
    }

    /// The name of its file without folder and ending.
    pub(crate) fn stem(&self) -> &str {
        let name = self.file.rsplit('/').next().unwrap_or(&self.file);
        name.strip_suffix(".csv").unwrap_or(name)
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.names.contains_key(name)
    }

    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|cells| Row { table: self, cells })
    }
}

impl<'a> Row<'a> {
    /// A cell; nothing where there is no such column.
    pub(crate) fn text(self, name: &str) -> &'a str {
        self.table.names.get(name).and_then(|&at| self.cells.get(at)).map_or("", String::as_str)
    }

    /// A cell as a number; 0 where it is none.
    pub(crate) fn number(self, name: &str) -> f64 {
        self.text(name).trim().parse().unwrap_or(0.0)
    }

    pub(crate) fn has(self, name: &str) -> bool {
        self.table.has(name)
    }
}

/// A cell as a line of CSV has it.
pub(crate) fn quoted(text: &str) -> String {
    if text.contains(['"', ',']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
