//! The paper's sentences beside our results, and what comes of them.

use crate::derivation::fail;
use crate::table::Row;
use crate::{Asked, Derivation, Derived, Table, VerdictError};
use pm_sweep::significant;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The paper's sentences beside our results: the verdicts as CSV, or with `list` the files of results that they need.
///
/// The head of `scripts/claims.csv` says how a line is written. Where a limit lies within the 95 % interval of what was
/// sampled, nothing is decided. It is an error if a result is missing.
pub(crate) const CLAIMS: Derivation = Derivation {
    word: "claims",
    help: "The paper's sentences beside our results, as CSV; or with `list` the files of results that they need",
    settings: &["list"],
    derive,
};

fn derive(asked: &Asked<'_>) -> Result<Derived, VerdictError> {
    let claims = asked.table(0)?;
    if asked.settings.contains_key("list") {
        let mut files: Vec<String> = vec![];
        let words = claims.rows().filter(|row| row.text("rule") != "none").flat_map(|row| row.text("ours").split(' '));
        for file in words.filter_map(Reference::read).map(|reference| reference.file()) {
            if !files.contains(&file) {
                files.push(file);
            }
        }
        return Ok(files.iter().map(|file| format!("{file}\n")).collect::<String>().into());
    }
    let mut results = Results { look_up: asked.look_up, tables: BTreeMap::new() };
    let mut text = "id,section,claim,unit,paper,ours,rule,verdict".replace("ours,", "ours,ratio,") + ",reason,how\n";
    for row in claims.rows() {
        let judged = match Verdict::of(row, &mut results) {
            Ok(judged) => judged,
            Err(VerdictError(why)) => return fail(format!("{}: {}: {why}", claims.file, row.text("id"))),
        };
        let _ = writeln!(
            text,
            "{},{},\"{}\",{},{},{},{},{},{},\"{}\",\"{}\"",
            row.text("id"),
            row.text("section"),
            row.text("claim"),
            row.text("unit"),
            row.text("paper"),
            judged.ours,
            judged.ratio,
            row.text("rule"),
            judged.verdict,
            judged.reason,
            row.text("ours")
        );
    }
    Ok(text.into())
}

/// `SWEEP/POINT:COLUMN`, of the cache `@SIZE` or of `@wWAYS`, else the first that has the column.
struct Reference<'a> {
    point: &'a str,
    which: Option<&'a str>,
    column: &'a str,
}

impl<'a> Reference<'a> {
    fn read(word: &'a str) -> Option<Self> {
        let (point, column) = word.split_once(':').filter(|(point, _)| point.contains('/'))?;
        let (point, which) = point.split_once('@').map_or((point, None), |(point, which)| (point, Some(which)));
        Some(Self { point, which, column })
    }

    fn file(&self) -> String {
        format!("out/{}.csv", self.point)
    }

    fn is_of(&self, row: Row<'_>) -> bool {
        match self.which.map(|which| (which, which.strip_prefix('w'))) {
            None => true,
            Some((_, Some(ways))) => row.text("ways") == ways,
            Some((size, None)) => {
                size.parse::<pm_size::Bytes>().is_ok_and(|bytes| row.number("cache_bytes") == bytes.0 as f64)
            }
        }
    }
}

/// Tables of results that were looked up.
struct Results<'a> {
    look_up: &'a dyn Fn(&str) -> Option<Table>,
    tables: BTreeMap<String, Option<Table>>,
}

impl Results<'_> {
    /// A result, and the square of its half width over it.
    fn value(&mut self, reference: &Reference<'_>) -> Result<(f64, f64), VerdictError> {
        let file = reference.file();
        let table = self.tables.entry(file.clone()).or_insert_with(|| (self.look_up)(&file));
        let row = table.iter().flat_map(Table::rows).find(|row| reference.is_of(*row));
        let column = reference.column;
        let Some(row) = row.filter(|row| !row.text(column).is_empty()) else {
            let of = reference.which.map_or(String::new(), |which| format!(" of {which}"));
            return fail(format!("{file} has no {column}{of}"));
        };
        let value = row.number(column);
        let doubt = if value == 0.0 { 0.0 } else { (row.number(&format!("{column}_error")) / value).powi(2) };
        Ok((value, doubt))
    }

    /// From left to right; relative half widths of independent estimates add up in squares.
    fn evaluated(&mut self, text: &str) -> Result<(f64, f64), VerdictError> {
        let words: Vec<&str> = text.split_whitespace().collect();
        let mut doubt = 0.0;
        let mut value = |word: &str| match (Reference::read(word), word.parse()) {
            (Some(reference), _) => {
                let (value, square) = self.value(&reference)?;
                doubt += square;
                Ok(value)
            }
            (None, Ok(number)) => Ok(number),
            _ => fail(format!("`{word}` is neither a number nor a result")),
        };
        let mut sum: f64 = value(words.first().copied().unwrap_or(""))?;
        for pair in words[1.min(words.len())..].chunks(2) {
            let right: f64 = value(pair.get(1).copied().unwrap_or(""))?;
            sum = match pair[0] {
                "*" => sum * right,
                "/" if right != 0.0 => sum / right,
                "/" => return fail(format!("division by zero in {text}")),
                "-" => sum - right,
                other => return fail(format!("`{other}` is none of * / -")),
            };
        }
        Ok((sum, doubt))
    }
}

struct Verdict<'a> {
    ours: String,
    ratio: String,
    verdict: &'static str,
    reason: &'a str,
}

const UNDECIDED: &str = "cannot be decided";

impl<'a> Verdict<'a> {
    fn of(row: Row<'a>, results: &mut Results<'_>) -> Result<Self, VerdictError> {
        let (rule, reason) = (row.text("rule"), row.text("reason"));
        if rule == "none" {
            return match reason {
                "" => fail("a claim that is not decided needs a reason"),
                _ => Ok(Self { ours: String::new(), ratio: String::new(), verdict: UNDECIDED, reason }),
            };
        }
        let (value, doubt) = results.evaluated(row.text("ours"))?;
        let (half, paper) = (value * doubt.sqrt(), row.number("paper"));
        let [low, high, middle] = [value - half, value + half, value].map(|value| holds(value, paper, rule));
        let verdict = match (low?, high?, middle?) {
            (true, true, _) => "confirmed",
            (false, false, false) => "not confirmed",
            _ => UNDECIDED,
        };
        let plus_minus = if doubt > 0.0 { format!(" ± {}", significant(half, 2)) } else { String::new() };
        Ok(Self {
            ours: significant(value, 4) + &plus_minus,
            ratio: if paper == 0.0 { String::new() } else { significant(value / paper, 3) },
            verdict,
            reason: if verdict == UNDECIDED { "the limit lies within the interval" } else { reason },
        })
    }
}

/// Whether the paper is right if this is the value: `<= x`, `>= x`, `within F`, `a..b`.
fn holds(value: f64, paper: f64, rule: &str) -> Result<bool, VerdictError> {
    let unknown = || VerdictError(format!("`{rule}` is no rule"));
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| unknown());
    if let Some((least, most)) = rule.split_once("..") {
        return Ok(value >= number(least)? && value <= number(most)?);
    }
    let (word, limit) = rule.split_once(' ').ok_or_else(unknown)?;
    let limit = number(limit)?;
    match word {
        "<=" => Ok(value <= limit),
        ">=" => Ok(value >= limit),
        "within" => Ok(value <= paper * limit && value >= paper / limit),
        _ => Err(unknown()),
    }
}
