//! Comma-separated values as RFC 4180 quotes them, with `\n` for a line end.

use std::{
    borrow::Cow,
    io::{self, Write},
};

use super::{Table, Value};

/// Writes the names of the columns, then a line for each row.
pub(super) fn write(table: &Table, out: &mut dyn Write) -> io::Result<()> {
    line(out, table.columns.iter().map(|c| quote(&c.name)))?;
    for row in &table.rows {
        line(out, row.iter().map(field))?;
    }
    Ok(())
}

fn line<'a>(out: &mut dyn Write, fields: impl Iterator<Item = Cow<'a, str>>) -> io::Result<()> {
    for (i, field) in fields.enumerate() {
        if i > 0 {
            out.write_all(b",")?;
        }
        out.write_all(field.as_bytes())?;
    }
    out.write_all(b"\n")
}

fn field(value: &Value) -> Cow<'_, str> {
    match value {
        Value::Int(n) => n.to_string().into(),
        Value::Signed(n) => n.to_string().into(),
        // The shortest digits that read back as the same number.
        Value::Float(x, _) if x.is_finite() => format!("{x:?}").into(),
        Value::Float(..) => "".into(),
        Value::Text(text) => quote(text),
    }
}

/// RFC 4180, section 2, rules 5 to 7.
fn quote(text: &str) -> Cow<'_, str> {
    if text.contains(['"', ',', '\n', '\r']) {
        return format!("\"{}\"", text.replace('"', "\"\"")).into();
    }
    text.into()
}

#[cfg(test)]
mod tests {
    use super::super::{Column, Format};
    use super::*;

    #[test]
    fn fields_are_quoted_when_they_must_be_and_numbers_lose_nothing() {
        let mut table = Table::new(vec![Column::text("cache"), Column::number("n"), Column::number("a \"b\"")]);
        table.push(vec![Value::Text("128K,full,128,lru".into()), Value::Int(u64::MAX), Value::Float(1.0 / 3.0, 3)]);
        table.push(vec![Value::Text("plain".into()), Value::Int(0), Value::Float(f64::NAN, 3)]);
        table.push(vec![Value::Text("two\nlines".into()), Value::Int(1), Value::Float(2e-9, 3)]);
        let mut out = Vec::new();
        table.write(Format::Csv, &mut out).unwrap();
        let expected = "\
cache,n,\"a \"\"b\"\"\"
\"128K,full,128,lru\",18446744073709551615,0.3333333333333333
plain,0,
\"two\nlines\",1,2e-9
";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }
}
