//! Tables as derivations read and write them: cells by the names of their columns.

use pm_report::sheet::{Sheet, number};
use pm_report::{Column, ReportError, TableFormat, Value};
use std::path::Path;

/// A table, and the text it was read from.
#[derive(Clone, Debug)]
pub struct Table {
    sheet: Sheet,
    text: String,
}

/// A row of a table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<'a> {
    sheet: &'a Sheet,
    at: usize,
}

impl Table {
    /// Reads CSV, or cells between tabs, as programs print them; lines that begin with `#` are remarks. An empty text has no
    /// columns and no rows.
    ///
    /// # Errors
    /// If it is no such text.
    pub fn read(file: &str, text: String) -> Result<Self, ReportError> {
        Ok(Self { sheet: Sheet::parse_with_remarks(file, text.as_bytes())?, text })
    }

    /// The text it was read from.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The table as others know it.
    pub(crate) const fn sheet(&self) -> &Sheet {
        &self.sheet
    }

    /// The name of its file without folder and ending.
    pub(crate) fn stem(&self) -> &str {
        Path::new(self.sheet.name()).file_stem().and_then(|stem| stem.to_str()).unwrap_or_default()
    }

    pub(crate) fn rows(&self) -> impl DoubleEndedIterator<Item = Row<'_>> {
        (0..self.sheet.rows().len()).map(|at| Row { sheet: &self.sheet, at })
    }
}

impl<'a> Row<'a> {
    /// A cell.
    ///
    /// # Errors
    /// If there is no such column.
    pub(crate) fn text(self, name: &str) -> Result<&'a str, ReportError> {
        Ok(&self.sheet.rows()[self.at][self.sheet.column(name)?])
    }

    /// A cell of a column that the table need not have; none, if it is empty.
    pub(crate) fn if_any(self, name: &str) -> Option<&'a str> {
        let cell = &self.sheet.rows()[self.at][self.sheet.find(name)?];
        (!cell.is_empty()).then_some(cell)
    }

    /// A cell as a number; 0 where it is empty, since what was not measured is nothing.
    ///
    /// # Errors
    /// If there is no such column, or another word stands there.
    pub(crate) fn number(self, name: &str) -> Result<f64, ReportError> {
        match self.text(name)? {
            "" => Ok(0.0),
            text => number(text).ok_or_else(|| self.wrong(format!("`{text}` in column {name} is not a number"))),
        }
    }

    /// An error about this row.
    pub(crate) fn wrong(self, what: impl std::fmt::Display) -> ReportError {
        ReportError::read(format!("{}, line {}: {what}", self.sheet.name(), self.sheet.line(self.at)))
    }
}

/// Rows of cells as CSV, under these names.
pub(crate) fn csv<const N: usize>(names: [&str; N], rows: impl IntoIterator<Item = [String; N]>) -> String {
    let mut table = pm_report::Table::new(names.map(Column::text).to_vec());
    rows.into_iter().for_each(|row| table.push(row.map(Value::Text).to_vec()));
    let mut csv = vec![];
    table.write(TableFormat::Csv, &mut csv).expect("memory takes all that is written");
    String::from_utf8(csv).expect("it is made of text")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Table {
        Table::read("out/t.csv", text.to_owned()).unwrap()
    }

    #[test]
    fn cells_are_found_by_the_names_of_their_columns() {
        for text in ["# remark\nname,n\na,1.5\n\"b, c\",\n", "name\tn\na\t1.5\nb, c\t\n"] {
            let table = table(text);
            let rows: Vec<Row<'_>> = table.rows().collect();
            assert_eq!((table.stem(), rows.len()), ("t", 2));
            assert_eq!((rows[0].text("name").unwrap(), rows[0].number("n").unwrap()), ("a", 1.5));
            assert_eq!((rows[1].text("name").unwrap(), rows[1].number("n").unwrap()), ("b, c", 0.0));
            assert_eq!((rows[0].if_any("n"), rows[1].if_any("n"), rows[0].if_any("m")), (Some("1.5"), None, None));
        }
        assert_eq!(table("").rows().count(), 0);
    }

    #[test]
    fn what_is_not_there_or_no_number_is_said() {
        let table = table("name,n\na,1\nb,many\n");
        let row = table.rows().last().unwrap();
        assert_eq!(row.number("n").unwrap_err().to_string(), "out/t.csv, line 3: `many` in column n is not a number");
        assert_eq!(row.number("m").unwrap_err().to_string(), "out/t.csv: there is no column `m`; there are name, n");
    }

    #[test]
    fn cells_are_quoted_where_they_must_be() {
        assert_eq!(csv(["a", "b"], [["1, \"2\"".to_owned(), String::new()]]), "a,b\n\"1, \"\"2\"\"\",\n");
    }
}
