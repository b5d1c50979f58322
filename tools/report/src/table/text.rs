//! Aligned columns for reading.

use std::io::{self, Write};

use super::{Align, Table, Value};
use crate::printable;

/// Writes `table` with two spaces between columns and none at the end of a line. A long name such as
/// `fetches_per_query` takes two lines, so that its column need not be as wide.
pub(super) fn write(table: &Table, out: &mut dyn Write) -> io::Result<()> {
    let (upper, lower): (Vec<String>, Vec<String>) = table.columns.iter().map(|c| head(&printable(&c.name))).unzip();
    let rows: Vec<Vec<String>> = table.rows.iter().map(|row| row.iter().map(cell).collect()).collect();
    let mut lines: Vec<&Vec<String>> = vec![];
    if upper.iter().any(|name| !name.is_empty()) {
        lines.push(&upper);
    }
    lines.push(&lower);
    lines.extend(&rows);
    let width = |i: usize| lines.iter().map(|line| line[i].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..lower.len()).map(width).collect();
    for row in lines {
        let mut line = String::new();
        for (i, text) in row.iter().enumerate() {
            let gap = if i == 0 { "" } else { "  " };
            line += &match table.columns[i].align {
                Align::Left => format!("{gap}{text:<w$}", w = widths[i]),
                Align::Right => format!("{gap}{text:>w$}", w = widths[i]),
            };
        }
        writeln!(out, "{}", line.trim_end())?;
    }
    Ok(())
}

/// The two lines of a column's head: `fetches` above `per_query`.
fn head(name: &str) -> (String, String) {
    match name.find("_per_") {
        Some(at) if at > 0 => (name[..at].to_owned(), name[at + 1..].to_owned()),
        _ => (String::new(), name.to_owned()),
    }
}

fn cell(value: &Value) -> String {
    match value {
        Value::Int(n) => n.to_string(),
        Value::Signed(n) => n.to_string(),
        Value::Float(x, digits) => float(*x, *digits),
        Value::Text(text) => printable(text).into_owned(),
    }
}

/// `x` with `digits` significant digits; digits before the point are never cut.
fn float(x: f64, digits: u8) -> String {
    if !x.is_finite() {
        return "-".to_owned();
    }
    let digits = i32::from(digits.max(1));
    if x == 0.0 {
        return format!("{:.*}", (digits - 1) as usize, 0.0);
    }
    // Scientific form rounds first, so that the exponent of 9.9999999 is that of 10.
    let scientific = format!("{:.*e}", (digits - 1) as usize, x);
    let exponent: i32 = scientific.rsplit('e').next().and_then(|e| e.parse().ok()).unwrap_or(0);
    if exponent < -5 {
        return scientific;
    }
    format!("{:.*}", (digits - 1 - exponent).max(0) as usize, x)
}

#[cfg(test)]
mod tests {
    use super::super::{Column, TableFormat};
    use super::*;

    fn text(table: &Table) -> String {
        let mut out = Vec::new();
        table.write(TableFormat::Table, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn columns_line_up() {
        let mut table = Table::new(vec![Column::text("cache"), Column::number("fetches"), Column::number("per_query")]);
        table.push(vec![Value::Text("128K,full,128,lru".into()), Value::Int(19_950_593), Value::Float(99.752_965, 6)]);
        table.push(vec![Value::Text("none".into()), Value::Int(7), Value::Float(f64::NAN, 6)]);
        let expected = "\
cache               fetches  per_query
128K,full,128,lru  19950593    99.7530
none                      7          -
";
        assert_eq!(text(&table), expected);
    }

    #[test]
    fn ratios_keep_their_significant_digits() {
        for (x, expected) in [
            (0.0, "0.00000"),
            (1.0, "1.00000"),
            (0.001_661_234_9, "0.00166123"),
            (9.999_999_9, "10.0000"),
            (123_456_789.5, "123456790"),
            (1.25e-9, "1.25000e-9"),
            (f64::INFINITY, "-"),
        ] {
            assert_eq!(float(x, 6), expected);
        }
    }

    #[test]
    fn a_hostile_name_stays_on_its_line() {
        let mut table = Table::new(vec![Column::text("name")]);
        table.push(vec![Value::Text("a\nb\u{1b}[2J".into())]);
        assert_eq!(text(&table).lines().count(), 2);
        assert!(!text(&table).contains('\u{1b}'));
    }

    #[test]
    fn long_names_take_two_lines() {
        let mut table = Table::new(vec![Column::text("cache"), Column::number("fetches_per_query")]);
        table.push(vec![Value::Text("none".into()), Value::Int(7)]);
        assert_eq!(text(&table), "         fetches\ncache  per_query\nnone           7\n");
    }

    #[test]
    fn no_rows_is_a_head_alone() {
        assert_eq!(text(&Table::new(vec![Column::text("a"), Column::number("b")])), "a  b\n");
    }
}
