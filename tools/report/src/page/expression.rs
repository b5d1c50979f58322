//! Numbers in texts: `{{ out/all.csv[order=scanline].fetches / hilbert | .1f }}`.

use super::description::line_at;
use super::sheet::number;
use super::{Description, Format, PageError, Sheets};
use std::fmt::Write as _;

/// What stands in a text for an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Written {
    /// The number, or the field as it is.
    pub(super) text: String,
    /// Where it is from: the places, as the description names them.
    pub(super) source: String,
    /// How it was found (the column `found` of the rows), if any row says it.
    pub(super) found: Option<String>,
}

/// A value, and how it came.
struct Value {
    field: String,
    number: Option<f64>,
    found: Vec<String>,
    source: String,
}

/// Evaluates what stands between the braces.
///
/// # Errors
/// If it cannot be read, or a file, row or column is not there, or what is to be reckoned with is not a number.
pub(super) fn evaluate(text: &str, page: &Description, sheets: &mut Sheets) -> Result<Written, PageError> {
    let inside = |error: PageError| PageError { what: format!("in {{{{{text}}}}}: {}", error.what), ..error };
    let (expression, format) = split_format(text);
    let format: Option<Format> =
        format.map(|format| format.parse().map_err(PageError::asked)).transpose().map_err(inside)?;
    let words = words(expression);
    let value = sum(&words, page, sheets).map_err(inside)?;
    let written = match (value.number, format) {
        (_, None) if words.len() == 1 => value.field.clone(),
        (Some(number), format) => format.map_or_else(|| number.to_string(), |format| format.write(number)),
        (None, Some(_)) => return Err(inside(not_a_number(&value))),
        (None, None) => value.field.clone(),
    };
    let found = (!value.found.is_empty()).then(|| value.found.join(" and "));
    Ok(Written { text: written, source: value.source, found })
}

fn not_a_number(value: &Value) -> PageError {
    PageError::asked(format!("{} is `{}`, which is not a number", value.source, value.field))
}

/// What stands before the last `|` outside brackets, and the format behind it.
fn split_format(text: &str) -> (&str, Option<&str>) {
    let mut depth = 0_u32;
    let mut bar = None;
    for (at, letter) in text.char_indices() {
        match letter {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            '|' if depth == 0 => bar = Some(at),
            _ => {}
        }
    }
    bar.map_or((text, None), |at| (&text[..at], Some(text[at + 1..].trim())))
}

/// The words of an expression; blanks in brackets part none.
fn words(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut depth = 0_u32;
    for letter in text.chars() {
        match letter {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        match words.last_mut() {
            Some(word) if depth > 0 || !letter.is_whitespace() => word.push(letter),
            _ => words.push(String::new()),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Terms between `+` and `-`.
fn sum(words: &[String], page: &Description, sheets: &mut Sheets) -> Result<Value, PageError> {
    match words.iter().rposition(|word| word == "+" || word == "-") {
        Some(at) => {
            let left = sum(&words[..at], page, sheets)?;
            let right = product(&words[at + 1..], page, sheets)?;
            reckon(left, &words[at], right)
        }
        None => product(words, page, sheets),
    }
}

/// Places, names and numbers between `*` and `/`.
fn product(words: &[String], page: &Description, sheets: &mut Sheets) -> Result<Value, PageError> {
    match words.iter().rposition(|word| word == "*" || word == "/") {
        Some(at) => {
            let left = product(&words[..at], page, sheets)?;
            let right = product(&words[at + 1..], page, sheets)?;
            reckon(left, &words[at], right)
        }
        None => match words {
            [word] => operand(word, page, sheets),
            _ => Err(PageError::asked(
                "a place such as FILE[COLUMN=VALUE].COLUMN, a name or a number is expected, with + - * / between blanks",
            )),
        },
    }
}

fn reckon(left: Value, operator: &str, right: Value) -> Result<Value, PageError> {
    let a = left.number.ok_or_else(|| not_a_number(&left))?;
    let b = right.number.ok_or_else(|| not_a_number(&right))?;
    let number = match operator {
        "+" => a + b,
        "-" => a - b,
        "*" => a * b,
        _ => a / b,
    };
    let source = format!("{} {operator} {}", left.source, right.source);
    if !number.is_finite() {
        return Err(PageError::asked(format!("{source} is not a number")));
    }
    let mut found = left.found;
    for more in right.found {
        if !found.contains(&more) {
            found.push(more);
        }
    }
    Ok(Value { field: number.to_string(), number: Some(number), found, source })
}

fn operand(word: &str, page: &Description, sheets: &mut Sheets) -> Result<Value, PageError> {
    if let Some(value) = number(word) {
        return Ok(Value { field: word.to_owned(), number: Some(value), found: vec![], source: word.to_owned() });
    }
    if word.contains('[') {
        return place(word, sheets);
    }
    match page.numbers.get(word) {
        Some(named) => place(named.as_ref(), sheets).map_err(|error| {
            let line = (!page.toml.is_empty()).then(|| line_at(&page.toml, named.span().start));
            error.at_line(line)
        }),
        None => Err(PageError::asked(format!(
            "`{word}` is neither a name of [numbers] nor a place such as FILE[COLUMN=VALUE].COLUMN"
        ))),
    }
}

/// The value at `FILE[COLUMN=VALUE, ...].COLUMN`.
fn place(text: &str, sheets: &mut Sheets) -> Result<Value, PageError> {
    let parts = text.trim().split_once('[').and_then(|(file, rest)| {
        let (chosen, column) = rest.rsplit_once("].")?;
        Some((file.trim(), chosen, column.trim()))
    });
    let (file, chosen, column) =
        parts.filter(|(file, _, column)| !file.is_empty() && !column.is_empty()).ok_or_else(|| {
            PageError::asked(format!("`{text}` is not a place; such as FILE[COLUMN=VALUE].COLUMN is expected"))
        })?;
    let sheet = sheets.get(file)?;
    let at = sheet.column(column)?;
    let chosen = conditions(chosen)?;
    let mut rows: Vec<&Vec<String>> = sheet.rows.iter().collect();
    let mut told = String::new();
    for (column, value) in &chosen {
        let at = sheet.column(column)?;
        rows.retain(|row| row[at] == *value);
        let _ = write!(told, "{}{column}={value}", if told.is_empty() { " with " } else { ", " });
    }
    let first = rows.first().ok_or_else(|| PageError::asked(format!("{file} has no row{told}")))?;
    if rows.iter().any(|row| row[at] != first[at]) {
        let many = rows.len();
        return Err(PageError::asked(format!(
            "{file} has {many} rows{told}, and they differ in {column}: name a column that tells them apart"
        )));
    }
    let found = sheet.find("found").map(|at| first[at].clone()).filter(|found| !found.is_empty());
    Ok(Value {
        field: first[at].clone(),
        number: number(&first[at]),
        found: found.into_iter().collect(),
        source: text.trim().to_owned(),
    })
}

/// `a=1, b="2, 3"` as pairs.
fn conditions(text: &str) -> Result<Vec<(String, String)>, PageError> {
    let mut pairs = vec![];
    let mut rest = text.trim();
    while !rest.is_empty() {
        let wrong =
            || PageError::asked(format!("`{rest}` is not such as COLUMN=VALUE or COLUMN=\"VALUE, WITH COMMA\""));
        let (column, behind) = rest.split_once('=').ok_or_else(wrong)?;
        let behind = behind.trim_start();
        let (value, after) = match behind.strip_prefix('"') {
            Some(quoted) => quoted.split_once('"').ok_or_else(wrong)?,
            None => behind.split_at(behind.find(',').unwrap_or(behind.len())),
        };
        pairs.push((column.trim().to_owned(), value.trim().to_owned()));
        let after = after.trim_start();
        rest = match after.strip_prefix(',') {
            Some(next) => next.trim_start(),
            None if after.is_empty() => after,
            None => return Err(wrong()),
        };
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "order,ways,fetches,found,verdict\n\
        scanline,1,1000,full,yes\nscanline,2,900,full,yes\n\"tiled, hilbert\",1,8,sampled,no\nempty,1,,,\n";

    fn written(text: &str) -> Result<Written, PageError> {
        let page = Description::parse(
            "title = 'T'\n[numbers]\nhilbert = 't.csv[order=\"tiled, hilbert\"].fetches'\nlost = 't.csv[order=x].fetches'",
        )?;
        let mut sheets = Sheets::default();
        sheets.add("t.csv", TABLE.as_bytes().to_vec())?;
        evaluate(text, &page, &mut sheets)
    }

    #[test]
    fn numbers_are_those_of_the_table() {
        for (text, expected, found) in [
            ("t.csv[order=scanline, ways=1].fetches", "1000", "full"),
            (" t.csv[order=scanline,ways=1].fetches | , ", "1,000", "full"),
            ("hilbert", "8", "sampled"),
            ("t.csv[order=scanline,ways=1].fetches / hilbert | .1f", "125.0", "full and sampled"),
            ("t.csv[order=scanline, ways=1].fetches - 2 * hilbert - 4 | .0f", "980", "full and sampled"),
            (
                "1 - t.csv[order=scanline,ways=2].fetches / t.csv[order=scanline,ways=1].fetches | .0%",
                "10\u{202f}%",
                "full",
            ),
            ("100 / 8 / 2", "6.25", ""),
            // Both rows say the same.
            ("t.csv[order=scanline].verdict", "yes", "full"),
        ] {
            let found = (!found.is_empty()).then(|| found.to_owned());
            let written = written(text).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((&*written.text, written.found), (expected, found), "{text}");
        }
    }

    #[test]
    fn what_is_not_there_is_said() {
        for (text, hint) in [
            ("u.csv[a=1].b", "in {{u.csv[a=1].b}}: u.csv: No such file"),
            ("t.csv[order=x].fetches", "t.csv has no row with order=x"),
            ("t.csv[order=scanline].fetches", "t.csv has 2 rows with order=scanline, and they differ in fetches"),
            ("t.csv[order=scanline,ways=1].fetch", "there is no column `fetch`"),
            ("t.csv[orders=scanline].fetches", "there is no column `orders`"),
            ("t.csv[order=empty].fetches | .1f", "t.csv[order=empty].fetches is ``, which is not a number"),
            ("t.csv[order=scanline].verdict / 2", "is `yes`, which is not a number"),
            ("1 / 0", "1 / 0 is not a number"),
            ("hilbrt", "`hilbrt` is neither a name"),
            ("hilbert | 3", "`3` is not a format"),
            ("hilbert hilbert", "a place such as"),
            ("", "a place such as"),
            ("hilbert /", "a place such as"),
            ("t.csv[order].fetches", "`order` is not such as"),
            ("t.csv[order=\"a\" b=1].fetches", "is not such as"),
            ("lost", "line 4: in {{lost}}: t.csv has no row with order=x"),
        ] {
            let error = written(text).expect_err(text).to_string();
            assert!(error.contains(hint), "{text}: {error}");
        }
    }
}
