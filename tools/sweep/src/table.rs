//! A table of experiments as it is written: columns, and lines of cells.

use crate::template::is_name;
use crate::{Stage, TableError};
use pm_registry::Choice as _;

/// What a column is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// It says what runs.
    Stage(Stage),
    /// A list of words, and the line stands for a point for each of them.
    Label(String),
    /// A label whose name stands in parentheses: it says something of the point, and nothing that runs depends on it.
    Remark(String),
}

impl Column {
    /// The name of a column of the result; none of what runs.
    #[must_use]
    pub fn label(&self) -> Option<&str> {
        match self {
            Self::Stage(_) => None,
            Self::Label(name) | Self::Remark(name) => Some(name),
        }
    }
}

/// A line of a table, below its line of names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Its number in the file, counted from 1.
    pub number: u64,
    /// A cell for each column.
    pub cells: Vec<String>,
}

/// A table as it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// What its file is called in messages.
    pub file: String,
    /// The number of the line of names.
    pub head: u64,
    /// Its columns.
    pub columns: Vec<Column>,
    /// Its lines.
    pub lines: Vec<Line>,
}

impl Table {
    /// Reads a table: CSV with a line of names. Lines that begin with `#` and empty ones say nothing.
    ///
    /// # Errors
    /// If a line is no CSV or has more cells than there are names, or a name is none that a column can have.
    pub fn read(file: &str, text: &str) -> Result<Self, TableError> {
        let mut lines = lines(file, text)?;
        if lines.is_empty() {
            return Err(TableError { file: file.into(), line: 1, what: "there is no point in this table".into() });
        }
        let Line { number: head, cells: names } = lines.remove(0);
        let mut table = Self { file: file.into(), head, columns: vec![], lines: vec![] };
        for name in &names {
            let column = table.column(name)?;
            let known = |other: &Column| match (other, &column) {
                (Column::Stage(a), Column::Stage(b)) => a == b,
                _ => other.label().is_some() && other.label() == column.label(),
            };
            if table.columns.iter().any(known) {
                return Err(table.error(head, format!("the column `{name}` stands twice")));
            }
            table.columns.push(column);
        }
        let width = names.len();
        for line in &mut lines {
            if line.cells.len() > width {
                let what = format!("has {} cells, and there are {width} columns", line.cells.len());
                return Err(table.error(line.number, what));
            }
            line.cells.resize(width, String::new());
        }
        if lines.is_empty() {
            return Err(table.error(head, "there is no point in this table"));
        }
        Ok(Self { lines, ..table })
    }

    fn column(&self, name: &str) -> Result<Column, TableError> {
        let column = match name.strip_prefix('(').and_then(|name| name.strip_suffix(')')) {
            Some(remark) => Column::Remark(remark.into()),
            None => Stage::of_word(name).map_or_else(|| Column::Label(name.into()), Column::Stage),
        };
        match column.label() {
            Some(label) if !is_name(label) || Stage::of_word(label).is_some() || label == crate::stage::OUT => {
                let what =
                    format!("`{name}` is no name for a label: letters, digits, _ and - are, but no stage's name");
                Err(self.error(self.head, what))
            }
            _ => Ok(column),
        }
    }

    /// An error in a line of the table.
    pub(crate) fn error(&self, line: u64, what: impl Into<String>) -> TableError {
        TableError { file: self.file.clone(), line, what: what.into() }
    }

    /// Names of its labels, remarks among them.
    pub fn labels(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().filter_map(Column::label)
    }
}

/// The lines of a file that say something, split into cells.
pub(crate) fn lines(file: &str, text: &str) -> Result<Vec<Line>, TableError> {
    let numbered = (1..).zip(text.trim_start_matches('\u{feff}').lines());
    let told = numbered.filter(|(_, line)| !line.starts_with('#') && !line.trim().is_empty());
    told.map(|(number, line)| {
        let error = |what: String| TableError { file: file.into(), line: number, what };
        // A cell ends on its line, or a quote is not closed.
        if !line.matches('"').count().is_multiple_of(2) {
            return Err(error("a quote is not closed".into()));
        }
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line.as_bytes());
        let record = reader.records().next().transpose().map_err(|e| error(e.to_string()))?.unwrap_or_default();
        Ok(Line { number, cells: record.iter().map(str::to_owned).collect() })
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        Table::read("t.csv", text).unwrap_err().to_string()
    }

    #[test]
    fn remarks_quotes_and_short_lines() {
        let text = "# a table\r\n\r\npoint,order,(found),cache\r\na,\"x,y\",\"say \"\"z\"\"\"\r\n  \r\n# end\r\nb\r\n";
        let table = Table::read("t.csv", text).unwrap();
        let label = |name: &str| Column::Label(name.into());
        let remark = Column::Remark("found".into());
        assert_eq!(table.columns, [Column::Stage(Stage::Point), label("order"), remark, Column::Stage(Stage::Cache)]);
        assert_eq!((table.head, table.lines[0].number, table.lines[1].number), (3, 4, 7));
        assert_eq!(table.lines[0].cells, ["a", "x,y", "say \"z\"", ""]);
        assert_eq!(table.lines[1].cells, ["b", "", "", ""]);
    }

    #[test]
    fn what_is_no_table_is_refused_with_its_line() {
        assert_eq!(error("# empty\n"), "t.csv:1: there is no point in this table");
        assert_eq!(error("\norder,queries\n"), "t.csv:2: there is no point in this table");
        assert_eq!(error("order,photons\nscanline,-n 500,x\n"), "t.csv:2: has 3 cells, and there are 2 columns");
        assert_eq!(error("order,(order)\nx,y\n"), "t.csv:1: the column `(order)` stands twice");
        assert_eq!(error("cache,cache\nx,y\n"), "t.csv:1: the column `cache` stands twice");
        assert_eq!(error("a\n\"x\ny\"\n"), "t.csv:2: a quote is not closed");
        for name in ["a b", "", "(queries)", "out", "(a", "1"] {
            assert!(error(&format!("k,{name},cache\n,,")).contains("is no name for a label"), "{name}");
        }
    }
}
