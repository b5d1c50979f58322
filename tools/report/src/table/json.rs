//! One JSON object with a schema number.

use std::io::{self, Write};

use serde::{Serialize, Serializer, ser::SerializeMap};

use super::{Column, Table, Value};

/// Version of the JSON form; goes up when a reader of the old form would misread the new one.
pub const JSON_SCHEMA: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    columns: Vec<&'a str>,
    rows: Vec<Row<'a>>,
}

/// A row as an object whose keys stand in the order of the columns.
struct Row<'a>(&'a [Column], &'a [Value]);

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (column, value) in self.0.iter().zip(self.1) {
            match value {
                Value::Int(n) => map.serialize_entry(&column.name, n)?,
                Value::Signed(n) => map.serialize_entry(&column.name, n)?,
                // Not finite becomes `null`.
                Value::Float(x, _) => map.serialize_entry(&column.name, x)?,
                Value::Text(text) => map.serialize_entry(&column.name, text)?,
            }
        }
        map.end()
    }
}

/// Writes the object, indented, and a line end.
pub(super) fn write(table: &Table, out: &mut dyn Write) -> io::Result<()> {
    let document = Document {
        schema: JSON_SCHEMA,
        columns: table.columns.iter().map(|c| c.name.as_str()).collect(),
        rows: table.rows.iter().map(|row| Row(&table.columns, row)).collect(),
    };
    serde_json::to_writer_pretty(&mut *out, &document)?;
    out.write_all(b"\n")
}

#[cfg(test)]
mod tests {
    use super::super::TableFormat;
    use super::*;

    #[test]
    fn a_reader_gets_back_what_was_put_in() {
        let mut table = Table::new(vec![Column::text("z"), Column::number("n"), Column::number("a")]);
        table.push(vec![Value::Text("say \"hi\"\n".into()), Value::Int(u64::MAX), Value::Float(0.1, 2)]);
        table.push(vec![Value::Text(String::new()), Value::Int(0), Value::Float(f64::INFINITY, 2)]);
        let mut out = Vec::new();
        table.write(TableFormat::Json, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let read: serde_json::Value = serde_json::from_str(&text).unwrap();
        let expected = serde_json::json!({
            "schema": 1,
            "columns": ["z", "n", "a"],
            "rows": [{"z": "say \"hi\"\n", "n": u64::MAX, "a": 0.1}, {"z": "", "n": 0, "a": null}],
        });
        assert_eq!(read, expected);
        // Keys stand in the order of the columns, not of the alphabet.
        assert!(text.find("\"n\":").unwrap() < text.find("\"a\":").unwrap());
    }

    #[test]
    fn a_full_disk_is_an_error() {
        struct Full;
        impl Write for Full {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::ErrorKind::StorageFull.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        for format in [TableFormat::Table, TableFormat::Csv, TableFormat::Json] {
            let error = Table::new(vec![Column::text("a")]).write(format, &mut Full).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        }
    }
}
