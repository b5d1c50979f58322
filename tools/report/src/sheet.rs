//! CSV files: read once, rows chosen by what their columns hold.

mod choose;
mod files;

use crate::ReportError;
use csv::StringRecord;

pub use choose::Values;
pub use files::Sheets;

/// Columns that an error lists; of more it names the nearest.
const MOST_LISTED: usize = 12;

/// A CSV file, read.
#[derive(Clone, Debug)]
pub struct Sheet {
    pub(crate) name: String,
    pub(crate) columns: Vec<String>,
    pub(crate) rows: Vec<StringRecord>,
    /// The line of each row, the first being 1.
    pub(crate) lines: Vec<u64>,
}

impl Sheet {
    /// Reads a table with a line of names; blanks around fields are no part of them. `name` is what errors call it.
    ///
    /// # Errors
    /// If it is not CSV, or empty.
    pub fn parse(name: &str, text: &[u8]) -> Result<Self, ReportError> {
        let sheet = Self::read(name, text, false, csv::ReaderBuilder::new().trim(csv::Trim::All))?;
        match sheet.columns.is_empty() {
            true => Err(ReportError::read(format!("{name}: the table is empty"))),
            false => Ok(sheet),
        }
    }

    /// Reads what programs print: fields between commas, or between tabs if there is one in the line of names. Lines that
    /// begin with `#` are remarks. Of nothing, there are no columns and no rows.
    ///
    /// # Errors
    /// If it is no such text.
    pub fn parse_with_remarks(name: &str, text: &[u8]) -> Result<Self, ReportError> {
        let names = text.split(|&byte| byte == b'\n').find(|line| !line.starts_with(b"#")).unwrap_or_default();
        let delimiter = if names.contains(&b'\t') { b'\t' } else { b',' };
        Self::read(name, text, true, csv::ReaderBuilder::new().comment(Some(b'#')).delimiter(delimiter))
    }

    fn read(name: &str, text: &[u8], remarks: bool, reader: &csv::ReaderBuilder) -> Result<Self, ReportError> {
        let mut reader = reader.from_reader(text);
        let wrong = |error: csv::Error| ReportError::read(format!("{name}: {error}"));
        let columns: Vec<String> = reader.headers().map_err(wrong)?.iter().map(str::to_owned).collect();
        let (mut rows, mut lines) = (vec![], vec![]);
        for record in reader.records() {
            let record = record.map_err(wrong)?;
            lines.push(record.position().map_or(0, |before| line_of_record(text, before, remarks)));
            rows.push(record);
        }
        Ok(Self { name: name.to_owned(), columns, rows, lines })
    }

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Names of its columns.
    #[must_use]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// Its rows, each with a field for every column.
    #[must_use]
    pub fn rows(&self) -> &[StringRecord] {
        &self.rows
    }

    /// The line of a row, the first being 1.
    #[must_use]
    pub fn line(&self, row: usize) -> u64 {
        self.lines.get(row).copied().unwrap_or(0)
    }

    /// The number of a column, if there is one of this name.
    #[must_use]
    pub fn find(&self, column: &str) -> Option<usize> {
        self.columns.iter().position(|known| known == column)
    }

    /// The number of a column.
    ///
    /// # Errors
    /// If there is none of this name: says which there are.
    pub fn column(&self, column: &str) -> Result<usize, ReportError> {
        self.find(column).ok_or_else(|| {
            let known = match self.columns.len() {
                0..=MOST_LISTED => format!("there are {}", self.columns.join(", ")),
                number => format!("of {number} columns the nearest are {}", self.nearest(column).join(", ")),
            };
            ReportError::asked(format!("{}: there is no column `{column}`; {known}", self.name))
        })
    }

    /// The three columns whose names are most like this.
    fn nearest(&self, wanted: &str) -> Vec<&str> {
        let mut columns: Vec<&str> = self.columns.iter().map(String::as_str).collect();
        let likeness = |column: &str| {
            let within = if column.contains(wanted) || wanted.contains(column) { 1.0 } else { 0.0 };
            within + strsim::jaro_winkler(column, wanted)
        };
        // Stable: of equals the one further left.
        columns.sort_by(|a, b| likeness(b).total_cmp(&likeness(a)));
        columns.truncate(3);
        columns
    }

    /// Puts the rows of another sheet below its own, by the names of the columns; what one of them lacks is empty.
    pub(crate) fn append(&mut self, other: &Self) {
        for column in &other.columns {
            if self.find(column).is_none() {
                self.add_column(column, vec![String::new(); self.rows.len()]);
            }
        }
        for row in &other.rows {
            let field = |column: &String| other.find(column).map_or("", |at| &row[at]);
            self.rows.push(self.columns.iter().map(field).collect());
        }
        self.lines.extend(&other.lines);
        self.name = format!("{}, {}", self.name, other.name);
    }

    /// Adds a column with these fields.
    pub(crate) fn add_column(&mut self, name: &str, fields: Vec<String>) {
        self.columns.push(name.to_owned());
        self.rows.iter_mut().zip(fields).for_each(|(row, field)| row.push_field(&field));
    }

    /// These columns as CSV, with their names.
    pub(crate) fn as_csv(&self, columns: &[usize]) -> String {
        let mut writer = csv::Writer::from_writer(vec![]);
        // Into memory, with as many fields in each row: this does not fail.
        let _ = writer.write_record(columns.iter().map(|&column| &self.columns[column]));
        for row in &self.rows {
            let _ = writer.write_record(columns.iter().map(|&column| &row[column]));
        }
        writer.into_inner().map_or(String::new(), |csv| String::from_utf8_lossy(&csv).into_owned())
    }
}

/// The line that a record begins on, where the reader was `before` it: lines that are empty, or remarks, may lie between.
fn line_of_record(text: &[u8], before: &csv::Position, remarks: bool) -> u64 {
    let rest = usize::try_from(before.byte()).ok().and_then(|at| text.get(at..)).unwrap_or_default();
    let passed_over = |line: &&[u8]| line.trim_ascii().is_empty() || remarks && line.starts_with(b"#");
    before.line() + rest.split(|&byte| byte == b'\n').take_while(passed_over).count() as u64
}

/// The number that a field holds.
#[must_use]
pub fn number(field: &str) -> Option<f64> {
    field.parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(text: &str) -> Sheet {
        Sheet::parse("t.csv", text.as_bytes()).expect("a table")
    }

    #[test]
    fn tables_are_put_together_by_the_names_of_columns() {
        let mut table = sheet("a,b\n1,2\n");
        table.append(&sheet("b,c\n3,4\n"));
        assert_eq!(table.columns, ["a", "b", "c"]);
        assert_eq!(table.rows, [vec!["1", "2", ""], vec!["", "3", "4"]]);
    }

    #[test]
    fn rows_know_their_lines_whatever_stands_between() {
        let table = Sheet::parse_with_remarks("t.csv", b"# remark\na,b\n\n1,\"2\n3\"\n# more\n4,5\n").expect("a table");
        assert_eq!((table.line(0), table.line(1)), (4, 7));
        assert_eq!(sheet("a\n\n\n1").line(0), 4);
    }
}
