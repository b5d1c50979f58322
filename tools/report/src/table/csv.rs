//! Comma-separated values as RFC 4180 quotes them, with `\n` for a line end.

use super::{Table, Value};
use std::borrow::Cow;
use std::io::{self, Write};

/// Writes the names of the columns, then a line for each row.
pub(super) fn write(table: &Table, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(table.columns.iter().map(|column| &column.name)).map_err(own)?;
    for row in &table.rows {
        writer.write_record(row.iter().map(|value| field(value).into_owned())).map_err(own)?;
    }
    writer.flush()
}

/// What the output said, not wrapped: whoever wrote it may want to know its kind.
fn own(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

fn field(value: &Value) -> Cow<'_, str> {
    match value {
        Value::Int(n) => n.to_string().into(),
        Value::Signed(n) => n.to_string().into(),
        // The shortest digits that read back as the same number.
        Value::Float(x, _) if x.is_finite() => format!("{x:?}").into(),
        Value::Float(..) => "".into(),
        Value::Text(text) => text.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Column, TableFormat};
    use super::*;

    #[test]
    fn fields_are_quoted_when_they_must_be_and_numbers_lose_nothing() {
        let mut table = Table::new(vec![Column::text("cache"), Column::number("n"), Column::number("a \"b\"")]);
        table.push(vec![Value::Text("128K,full,128,lru".into()), Value::Int(u64::MAX), Value::Float(1.0 / 3.0, 3)]);
        table.push(vec![Value::Text("plain".into()), Value::Int(0), Value::Float(f64::NAN, 3)]);
        table.push(vec![Value::Text("two\nlines".into()), Value::Int(1), Value::Float(2e-9, 3)]);
        let mut out = Vec::new();
        table.write(TableFormat::Csv, &mut out).unwrap();
        let expected = "\
cache,n,\"a \"\"b\"\"\"
\"128K,full,128,lru\",18446744073709551615,0.3333333333333333
plain,0,
\"two\nlines\",1,2e-9
";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }
}
