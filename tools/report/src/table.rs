//! A table of results: columns, and rows of values.

mod csv;
mod json;
mod text;

use std::io::{self, Write};

pub use json::JSON_SCHEMA;

pm_registry::choices! {
    /// How a table is written. Never chosen by whether the output is a terminal.
    #[derive(Debug, Default)]
    pub enum TableFormat {
        /// Aligned columns for reading
        #[default]
        Table = "table",
        /// Comma-separated values with a line of names
        Csv = "csv",
        /// One JSON object with a schema number
        Json = "json",
    }
}

/// On which side of its column a value stands in the `table` format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Names and other words.
    Left,
    /// Numbers.
    Right,
}

/// What a column holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name, unit included, such as `bytes_per_query`.
    pub name: String,
    /// Where its values stand in the `table` format.
    pub align: Align,
}

impl Column {
    /// A column of words.
    pub fn text(name: impl Into<String>) -> Self {
        Self { name: name.into(), align: Align::Left }
    }

    /// A column of numbers.
    pub fn number(name: impl Into<String>) -> Self {
        Self { name: name.into(), align: Align::Right }
    }
}

/// One cell of a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// An exact count.
    Int(u64),
    /// An exact difference of counts.
    Signed(i64),
    /// A ratio, and how many significant digits of it the `table` format shows. Not a number: there is no such ratio.
    Float(f64, u8),
    /// Words.
    Text(String),
}

/// Columns and rows of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Value>>,
}

impl Table {
    /// A table without rows.
    ///
    /// # Panics
    ///
    /// If two columns have the same name: a JSON row could not hold both.
    #[must_use]
    pub fn new(columns: Vec<Column>) -> Self {
        for (i, column) in columns.iter().enumerate() {
            assert!(columns[..i].iter().all(|c| c.name != column.name), "two columns named {}", column.name);
        }
        Self { columns, rows: Vec::new() }
    }

    /// Adds a row, a value for each column.
    ///
    /// # Panics
    ///
    /// If the row has more or fewer values than the table has columns.
    pub fn push(&mut self, row: Vec<Value>) {
        assert_eq!(row.len(), self.columns.len(), "a row must have one value for each column");
        self.rows.push(row);
    }

    /// The columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The rows, in the order they were added.
    #[must_use]
    pub fn rows(&self) -> &[Vec<Value>] {
        &self.rows
    }

    /// Writes the whole table.
    ///
    /// # Errors
    ///
    /// What `out` reports.
    pub fn write(&self, format: TableFormat, out: &mut dyn Write) -> io::Result<()> {
        match format {
            TableFormat::Table => text::write(self, out),
            TableFormat::Csv => csv::write(self, out),
            TableFormat::Json => json::write(self, out),
        }
    }
}
