//! Which rows of a sheet, and in which order.

use super::{Sheet, number};
use crate::ReportError;
use csv::StringRecord;
use serde::Deserialize;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Values that a column may have, or the one.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Values {
    /// This one.
    One(String),
    /// Any of these.
    Any(Vec<String>),
}

impl Values {
    /// All of them.
    #[must_use]
    pub fn all(&self) -> &[String] {
        match self {
            Self::One(value) => std::slice::from_ref(value),
            Self::Any(values) => values,
        }
    }
}

impl Sheet {
    /// Keeps the rows that have, in each of these columns, one of its values.
    ///
    /// # Errors
    /// If a column is not there, or one of the values stands in no row: what is asked for is misspelt, or missing.
    pub(crate) fn keep(&mut self, only: &BTreeMap<String, Values>) -> Result<(), ReportError> {
        for (column, values) in only {
            let at = self.column(column)?;
            let lost = values.all().iter().find(|value| !self.rows.iter().any(|row| row[at] == **value));
            if let Some(value) = lost {
                return Err(ReportError::asked(format!("{}: no row is left with `{value}` in {column}", self.name)));
            }
            self.retain(|row| values.all().iter().any(|value| *value == row[at]));
        }
        Ok(())
    }

    /// Keeps the rows that have, in each of these columns that it has, one of its values, even if that is none.
    pub(crate) fn keep_what_fits(&mut self, only: &BTreeMap<String, Values>) {
        for (column, values) in only {
            if let Some(at) = self.find(column) {
                self.retain(|row| values.all().iter().any(|value| *value == row[at]));
            }
        }
    }

    /// Keeps rows, and their lines.
    pub(crate) fn retain(&mut self, keep: impl FnMut(&StringRecord) -> bool) {
        let kept: Vec<bool> = self.rows.iter().map(keep).collect();
        let (mut of_rows, mut of_lines) = (kept.iter(), kept.iter());
        self.rows.retain(|_| of_rows.next() == Some(&true));
        self.lines.retain(|_| of_lines.next() == Some(&true));
    }

    /// Sorts the rows by these columns, the first one first, numbers by their value and before words; behind `-` stands a
    /// column whose greatest value comes first. Equal rows stay as they are.
    ///
    /// # Errors
    /// If a column is not there.
    pub(crate) fn sort(&mut self, by: &[String]) -> Result<(), ReportError> {
        for column in by.iter().rev() {
            let (name, down) = column.strip_prefix('-').map_or((&**column, false), |name| (name, true));
            let at = self.column(name)?;
            let mut rows: Vec<_> = std::mem::take(&mut self.rows).into_iter().zip(&self.lines).collect();
            rows.sort_by(|(a, _), (b, _)| {
                let order = compare(&a[at], &b[at]);
                if down { order.reverse() } else { order }
            });
            (self.rows, self.lines) = rows.into_iter().unzip();
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

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(text: &str) -> Sheet {
        Sheet::parse("t.csv", text.as_bytes()).expect("a table")
    }

    fn rows(sheet: &Sheet) -> Vec<String> {
        sheet.rows.iter().map(|row| row.iter().collect::<Vec<_>>().join(" ")).collect()
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
        assert_eq!(table.lines, [2, 4]);
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
        assert_eq!(table.lines, [2, 3, 5, 4]);
    }
}
