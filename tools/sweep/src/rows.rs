//! Rows as a point prints them: a line of names, and at least one line of as many cells.

use crate::SweepError;

/// A table of rows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rows {
    /// Names of the columns.
    pub names: Vec<String>,
    /// The rows, a cell for each name.
    pub rows: Vec<Vec<String>>,
}

impl Rows {
    /// Reads rows.
    ///
    /// # Errors
    /// If there is none, or one is cut.
    pub fn read(file: &str, bytes: &[u8]) -> Result<Self, SweepError> {
        let error = |what: String| SweepError::new(file, what);
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(bytes);
        let mut rows = vec![];
        for record in reader.records() {
            let record = record.map_err(|e| error(format!("holds no rows that belong together: {e}")))?;
            rows.push(record.iter().map(str::to_owned).collect::<Vec<_>>());
        }
        if rows.len() < 2 {
            return Err(error("no row came back".into()));
        }
        if !bytes.ends_with(b"\n") {
            return Err(error("the last row is cut".into()));
        }
        Ok(Self { names: rows.remove(0), rows })
    }

    /// The rows as CSV.
    #[must_use]
    pub fn to_csv(&self) -> Vec<u8> {
        let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(vec![]);
        for row in [&self.names].into_iter().chain(&self.rows) {
            writer.write_record(row).expect("memory takes all");
        }
        writer.into_inner().expect("memory takes all")
    }

    /// The place of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|other| other == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_believed_when_they_are_whole() {
        let read = |text: &str| Rows::read("out/a.csv", text.as_bytes()).map_err(|error| error.to_string());
        let text = "a,b\n1,\"x, \"\"y\"\"\"\n,2\n";
        assert_eq!(read(text).unwrap().to_csv(), text.as_bytes());
        for (text, why) in [("", "no row came back"), ("a,b\n", "no row came back"), ("a,b\n1\n", "belong together")] {
            assert!(read(text).unwrap_err().contains(why), "{text}");
        }
        assert_eq!(read("a,b\n1,2").unwrap_err(), "out/a.csv: the last row is cut");
    }
}
