//! Numbers in texts: `{{ row('out/all.csv', order='scanline').fetches / hilbert | .1f }}`.

use super::NumberFormat;
use super::below::FOUND;
use crate::ReportError;
use crate::expression::{Evaluator, Found, not_a_number};

/// What stands in a text for an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Written {
    /// The number, or the field as it is.
    pub(super) text: String,
    /// Where it is from: the expression, with what its names stand for.
    pub(super) source: String,
    /// How it was found (the column `found` of the rows), if any row says it.
    pub(super) found: Option<String>,
}

/// Evaluates what stands between the braces: an expression and, behind the last `|`, how the number is written.
///
/// # Errors
/// If it cannot be read, or a file, row or column is not there, or what is to be reckoned with is not a number.
pub(super) fn evaluate(text: &str, evaluator: &Evaluator) -> Result<Written, ReportError> {
    written(text, evaluator).map_err(|error| error.inside(&format!("{{{{{text}}}}}")))
}

fn written(text: &str, evaluator: &Evaluator) -> Result<Written, ReportError> {
    let (expression, format) = split_format(text);
    let format: Option<NumberFormat> = format.map(|format| format.parse().map_err(ReportError::asked)).transpose()?;
    let Found { number, text, source, places } = evaluator.evaluate(expression)?;
    let text = match (number, format) {
        (Some(number), Some(format)) => format.write(number),
        (None, Some(_)) => {
            let word = places.first().map_or_else(|| format!("{source} is not a number"), not_a_number);
            return Err(ReportError::asked(word));
        }
        (_, None) => text,
    };
    let mut found: Vec<&str> = vec![];
    for word in places.iter().filter_map(|place| place.beside(FOUND)) {
        if !word.is_empty() && !found.contains(&word) {
            found.push(word);
        }
    }
    Ok(Written { text, source, found: (!found.is_empty()).then(|| found.join(" and ")) })
}

/// What stands before the last `|`, and the format behind it; a `|` in brackets or quotes parts nothing.
fn split_format(text: &str) -> (&str, Option<&str>) {
    let behind = text.rsplit_once('|').filter(|(_, format)| !format.contains(['"', '\'', ')', ']']));
    behind.map_or((text, None), |(expression, format)| (expression, Some(format.trim())))
}

#[cfg(test)]
mod tests {
    use super::super::Description;
    use super::*;
    use crate::sheet::Sheets;

    const TABLE: &str = "order,ways,fetches,found,verdict\n\
        scanline,1,1000,full,yes\nscanline,2,900,full,yes\n\"tiled, hilbert\",1,8,sampled,no\nempty,1,,,\n";

    fn written(text: &str) -> Result<Written, ReportError> {
        let page = Description::parse(
            "title = 'T'\n[numbers]\nhilbert = \"row('t.csv', order='tiled, hilbert').fetches\"\n\
             lost = \"row('t.csv', order='x').fetches\"",
        )?;
        let sheets = Sheets::default();
        sheets.add("t.csv", TABLE.as_bytes())?;
        evaluate(text, &page.evaluator(&sheets))
    }

    #[test]
    fn numbers_are_those_of_the_table() {
        for (text, expected, found) in [
            ("row('t.csv', order='scanline', ways=1).fetches", "1000", "full"),
            (" row('t.csv', order='scanline',ways=1).fetches | , ", "1,000", "full"),
            ("hilbert", "8", "sampled"),
            ("row('t.csv', order='scanline',ways=1).fetches / hilbert | .1f", "125.0", "full and sampled"),
            ("row('t.csv', order='scanline', ways='1').fetches - 2 * hilbert - 4 | .0f", "980", "full and sampled"),
            (
                "1 - row('t.csv', order='scanline',ways=2).fetches / row('t.csv', order='scanline',ways=1).fetches | .0%",
                "10\u{202f}%",
                "full",
            ),
            ("100 / 8 / 2", "6.25", ""),
            // Both rows say the same.
            ("row('t.csv', order='scanline').verdict", "yes", "full"),
        ] {
            let found = (!found.is_empty()).then(|| found.to_owned());
            let written = written(text).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((&*written.text, written.found), (expected, found), "{text}");
        }
    }

    #[test]
    fn a_number_says_what_it_is_made_of() {
        let written = written(" hilbert / 2 * hilbert | .1f").unwrap();
        let place = "row('t.csv', order='tiled, hilbert').fetches";
        assert_eq!(written.source, format!("{place} / 2 * {place}"));
    }

    #[test]
    fn what_is_not_there_is_said() {
        for (text, hint) in [
            ("row('u.csv', a=1).b", "in {{row('u.csv', a=1).b}}: u.csv: No such file"),
            ("row('t.csv', order='x').fetches", "t.csv has no row with order=x"),
            (
                "row('t.csv', order='scanline').fetches",
                "t.csv has 2 rows with order=scanline, and they differ in fetches",
            ),
            ("row('t.csv', order='scanline',ways=1).fetch", "there is no column `fetch`"),
            ("row('t.csv', orders='scanline').fetches", "there is no column `orders`"),
            (
                "row('t.csv', order='empty').fetches | .1f",
                "row('t.csv', order='empty').fetches is ``, which is not a number",
            ),
            ("row('t.csv', order='scanline').verdict / 2", "is `yes`, which is not a number"),
            ("1 / 0", "1 / 0"),
            ("hilbrt", "`hilbrt` is neither a name"),
            ("hilbert | 3", "`3` is not a format"),
            ("hilbert hilbert", "a place such as"),
            ("", "a place such as"),
            ("hilbert /", "a place such as"),
            ("row('t.csv', 'scanline').fetches", "too many arguments"),
            ("row('t.csv', order='a' b=1).fetches", "a place such as"),
            ("row('t.csv', order='scanline')", "is no number; a column"),
            ("lost", "line 4: in {{lost}}: t.csv has no row with order=x"),
        ] {
            let error = written(text).expect_err(text).to_string();
            assert!(error.contains(hint), "{text}: {error}");
        }
    }
}
