//! The CSV files of a page: read once, rows chosen by what their columns hold.

use super::PageError;
use super::description::Values;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// A CSV file, read.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    /// How it is called in the description.
    pub(super) name: String,
    /// Names of its columns.
    pub(super) columns: Vec<String>,
    /// Its rows, each with a field for every column.
    pub(super) rows: Vec<Vec<String>>,
    /// The file as it is.
    pub(super) text: Vec<u8>,
}

impl Sheet {
    fn parse(name: &str, text: Vec<u8>) -> Result<Self, PageError> {
        let wrong = |error: csv::Error| PageError::read(format!("{name}: {error}"));
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(&*text);
        let columns: Vec<String> = reader.headers().map_err(wrong)?.iter().map(str::to_owned).collect();
        if columns.is_empty() {
            return Err(PageError::read(format!("{name}: the table is empty")));
        }
        let row =
            |record: csv::Result<csv::StringRecord>| Ok(record.map_err(wrong)?.iter().map(str::to_owned).collect());
        let rows = reader.records().map(row).collect::<Result<_, PageError>>()?;
        Ok(Self { name: name.to_owned(), columns, rows, text })
    }

    /// The number of a column, if there is one of this name.
    pub(super) fn find(&self, column: &str) -> Option<usize> {
        self.columns.iter().position(|known| known == column)
    }

    /// The number of a column.
    ///
    /// # Errors
    /// If there is none of this name: says which there are.
    pub(super) fn column(&self, column: &str) -> Result<usize, PageError> {
        self.find(column).ok_or_else(|| {
            let columns = self.columns.join(", ");
            PageError::asked(format!("{}: there is no column `{column}`; there are {columns}", self.name))
        })
    }

    /// Keeps the rows that have, in each of these columns, one of its values.
    ///
    /// # Errors
    /// If a column is not there, or one of the values stands in no row: what is asked for is misspelt, or missing.
    pub(super) fn keep(&mut self, only: &BTreeMap<String, Values>) -> Result<(), PageError> {
        for (column, values) in only {
            let at = self.column(column)?;
            let lost = values.all().iter().find(|value| !self.rows.iter().any(|row| row[at] == **value));
            if let Some(value) = lost {
                return Err(PageError::asked(format!("{}: no row is left with `{value}` in {column}", self.name)));
            }
            self.rows.retain(|row| values.all().contains(&row[at]));
        }
        Ok(())
    }

    /// Keeps the rows that have, in each of these columns that it has, one of its values, even if that is none.
    pub(super) fn keep_what_fits(&mut self, only: &BTreeMap<String, Values>) {
        for (column, values) in only {
            if let Some(at) = self.find(column) {
                self.rows.retain(|row| values.all().contains(&row[at]));
            }
        }
    }

    /// Puts the rows of another sheet below its own, by the names of the columns; what one of them lacks is empty.
    pub(super) fn append(&mut self, other: &Self) {
        for column in &other.columns {
            if self.find(column).is_none() {
                self.add_column(column, vec![String::new(); self.rows.len()]);
            }
        }
        for row in &other.rows {
            let field = |column: &String| other.find(column).map_or(String::new(), |at| row[at].clone());
            self.rows.push(self.columns.iter().map(field).collect());
        }
        self.name = format!("{}, {}", self.name, other.name);
    }

    /// Adds a column with these fields.
    pub(super) fn add_column(&mut self, name: &str, fields: Vec<String>) {
        self.columns.push(name.to_owned());
        self.rows.iter_mut().zip(fields).for_each(|(row, field)| row.push(field));
    }

    /// Sorts the rows by these columns, the first one first, numbers by their value and before words; behind `-` stands a
    /// column whose greatest value comes first. Equal rows stay as they are.
    ///
    /// # Errors
    /// If a column is not there.
    pub(super) fn sort(&mut self, by: &[String]) -> Result<(), PageError> {
        for column in by.iter().rev() {
            let (name, down) = column.strip_prefix('-').map_or((&**column, false), |name| (name, true));
            let at = self.column(name)?;
            self.rows.sort_by(|a, b| {
                let order = compare(&a[at], &b[at]);
                if down { order.reverse() } else { order }
            });
        }
        Ok(())
    }
}

fn compare(a: &str, b: &str) -> Ordering {
    match (number(a), number(b)) {
        (Some(a), Some(b)) => a.total_cmp(&b),
        (Some(_), None) => Ordering::Less,
        (None, Some(_)) => Ordering::Greater,
        (None, None) => a.cmp(b),
    }
}

/// The number that a field holds.
pub(super) fn number(field: &str) -> Option<f64> {
    field.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Where the files of a page are, and those that were read.
#[derive(Clone, Debug, Default)]
pub struct Sheets {
    folder: PathBuf,
    read: BTreeMap<String, Rc<Sheet>>,
}

impl Sheets {
    /// Files named from this folder.
    #[must_use]
    pub fn of_folder(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), read: BTreeMap::new() }
    }

    /// A table that is there already, as if it were a file of this name.
    ///
    /// # Errors
    /// If it is not CSV.
    pub fn add(&mut self, name: &str, csv: Vec<u8>) -> Result<(), PageError> {
        self.read.insert(name.to_owned(), Rc::new(Sheet::parse(name, csv)?));
        Ok(())
    }

    /// A table, read now or before.
    ///
    /// # Errors
    /// If it cannot be read, or is not CSV.
    pub(super) fn get(&mut self, name: &str) -> Result<Rc<Sheet>, PageError> {
        if !self.read.contains_key(name) {
            let text = self.bytes(name)?;
            self.add(name, text)?;
        }
        Ok(Rc::clone(&self.read[name]))
    }

    /// The bytes of any file.
    ///
    /// # Errors
    /// If it cannot be read.
    pub(super) fn bytes(&self, name: &str) -> Result<Vec<u8>, PageError> {
        fs::read(self.folder.join(name)).map_err(|error| PageError::read(format!("{name}: {error}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(text: &str) -> Sheet {
        Sheet::parse("t.csv", text.as_bytes().to_vec()).expect("a table")
    }

    fn rows(sheet: &Sheet) -> Vec<String> {
        sheet.rows.iter().map(|row| row.join(" ")).collect()
    }

    #[test]
    fn rows_are_chosen_and_a_choice_of_none_is_an_error() {
        let mut table = sheet("order,ways,n\na,1,5\nb,1,6\nc,2,7\n");
        let only = |pairs: &[(&str, &[&str])]| {
            let values = |values: &[&str]| Values::Any(values.iter().map(|&v| v.to_owned()).collect());
            pairs.iter().map(|&(column, v)| (column.to_owned(), values(v))).collect::<BTreeMap<_, _>>()
        };
        table.keep(&only(&[("order", &["a", "c"])])).unwrap();
        assert_eq!(rows(&table), ["a 1 5", "c 2 7"]);
        let error = table.keep(&only(&[("order", &["a"]), ("ways", &["2"])])).unwrap_err().to_string();
        assert_eq!(error, "t.csv: no row is left with `2` in ways");
        let error = table.keep(&only(&[("way", &["2"])])).unwrap_err().to_string();
        assert_eq!(error, "t.csv: there is no column `way`; there are order, ways, n");
    }

    #[test]
    fn numbers_are_sorted_by_value_and_before_words() {
        let mut table = sheet("order,ways\na,full\nb,16\nc,2\na,2\n");
        table.sort(&["ways".into()]).unwrap();
        assert_eq!(rows(&table), ["c 2", "a 2", "b 16", "a full"]);
        table.sort(&["-ways".into(), "order".into()]).unwrap();
        assert_eq!(rows(&table), ["a full", "b 16", "a 2", "c 2"]);
    }

    #[test]
    fn tables_are_put_together_by_the_names_of_columns() {
        let mut table = sheet("a,b\n1,2\n");
        table.append(&sheet("b,c\n3,4\n"));
        assert_eq!(table.columns, ["a", "b", "c"]);
        assert_eq!(rows(&table), ["1 2 ", " 3 4"]);
    }
}
