//! Is the light right?

use crate::batches::part;
use crate::table::Row;
use crate::{Asked, Derivation, Derived, Table, VerdictError};
use pm_sweep::significant;
use std::collections::HashMap;
use std::fmt::Write as _;

/// What was found beside what is known, and whether it is near enough.
///
/// The first table says what is known (its head explains it). The others, named after their experiments, are what
/// `pm-view --mean --format csv` prints, or rows of name,r,g,b and maybe the standard errors se_r,se_g,se_b. The difference
/// printed is that of the worst channel.
pub(crate) const ACCURACY: Derivation = Derivation {
    word: "accuracy",
    help: "What experiments found beside what is known, and whether it is near enough",
    settings: &[],
    derive,
};

const CHANNELS: [&str; 3] = ["r", "g", "b"];
/// Numbers of things, which have one channel only.
const COUNTS: &str = "searches";

/// What was found of a part of an experiment.
#[derive(Clone, Copy, Default)]
struct Found {
    pixels: f64,
    value: [Option<f64>; 3],
    error: [f64; 3],
}

/// By experiment and part.
type All = HashMap<(String, String), Found>;

fn derive(asked: &Asked<'_>) -> Result<Derived, VerdictError> {
    let mut found = All::new();
    for table in asked.tables.iter().skip(1) {
        for row in table.rows() {
            found.insert((table.stem().to_owned(), part(row)), read(table, row));
        }
    }
    let mut text = line(&["scene and experiment", "known (r g b)", "found (r g b)", "difference", "tolerance", ""]);
    let (mut rows, mut bad, mut largest_error) = (0, 0, 0.0_f64);
    for known in asked.table(0)?.rows() {
        rows += 1;
        let judged = Judged::new(known, &found);
        bad += usize::from(!judged.is_good);
        if judged.is_by_errors && !judged.is_missing {
            largest_error = largest_error.max(judged.error_at_worst);
        }
        let verdict = if judged.is_good { "ok" } else { "NOT OK" };
        text += &line(&[
            known.text("what"),
            &judged.known,
            &judged.found,
            &judged.difference,
            known.text("tolerance"),
            verdict,
        ]);
    }
    if largest_error > 0.0 {
        let error = significant(largest_error, 2);
        let _ = writeln!(text, "\nStandard errors (SE) of the fluxes are at most {error} of what is emitted.");
    }
    if rows == 0 || bad > 0 {
        let _ = writeln!(text, "{bad} of {rows} rows are NOT OK");
        return Ok(Derived { text, fault: Some(format!("{bad} of {rows} rows are not near enough to what is known")) });
    }
    let _ = writeln!(text, "all {rows} rows are ok");
    Ok(text.into())
}

fn line([what, known, found, difference, tolerance, verdict]: &[&str; 6]) -> String {
    format!("{what:<46} {known:<27} {found:<27} {difference:>11}  {tolerance:<10} {verdict}\n")
}

fn read(table: &Table, row: Row<'_>) -> Found {
    let pixels = if table.has("pixels") { row.number("pixels") } else { 1.0 };
    // What is no number was not measured: nan is neither near nor far.
    let value = CHANNELS.map(|channel| row.text(channel).parse().ok().filter(|x: &f64| x.is_finite()));
    Found { pixels, value, error: CHANNELS.map(|channel| row.number(&format!("se_{channel}"))) }
}

/// The value of a part of an experiment, a rectangle less another where there is a minus, if it was measured.
fn value(found: &All, experiment: &str, part: &str, channel: usize) -> Option<f64> {
    let of = |part: &str| found.get(&(experiment.to_owned(), part.to_owned()));
    let Some((whole, hole)) = part.split_once(" - ") else { return of(part)?.value[channel] };
    let (whole, hole) = (of(whole)?, of(hole)?);
    let sum = whole.value[channel]? * whole.pixels - hole.value[channel]? * hole.pixels;
    Some(sum / (whole.pixels - hole.pixels))
}

fn shown(x: Option<f64>) -> String {
    x.map_or("-".into(), |x| if x >= 1000.0 { format!("{x:.0}") } else { significant(x, 5) })
}

/// A row of what is known, and how near to it we are.
struct Judged {
    known: String,
    found: String,
    difference: String,
    error_at_worst: f64,
    is_by_errors: bool,
    is_missing: bool,
    is_good: bool,
}

impl Judged {
    fn new(known: Row<'_>, found: &All) -> Self {
        let (experiment, part) = (known.text("experiment"), known.text("part"));
        let words: Vec<&str> = known.text("tolerance").split_whitespace().collect();
        let (first, second) = (words.first().copied().unwrap_or(""), words.get(1).copied().unwrap_or(""));
        let is_by_errors = words.last() == Some(&"SE");
        let (mut knowns, mut founds) = (vec![], vec![]);
        let (mut worst, mut error_at_worst, mut is_missing) = (0.0_f64, 0.0, false);
        for (c, channel) in CHANNELS.iter().enumerate() {
            if c > 0 && part == COUNTS {
                break;
            }
            let expected = match known.text("r").strip_prefix('=') {
                Some(other) => value(found, other, part, c),
                None => known.text(channel).parse().ok(),
            };
            let got = value(found, experiment, part, c);
            knowns.push(shown(expected));
            founds.push(shown(got));
            let (Some(expected), Some(got)) = (expected.filter(|x: &f64| *x != 0.0), got) else {
                is_missing = true;
                continue;
            };
            let (mut off, mut error) = (100.0 * (got / expected - 1.0), 0.0);
            if is_by_errors {
                let ours = found.get(&(experiment.to_owned(), part.to_owned())).map_or(0.0, |found| found.error[c]);
                error = ours.hypot(known.number(&format!("se_{channel}")));
                if error == 0.0 {
                    is_missing = true;
                    continue;
                }
                off = (got - expected) / error;
            } else if first == "at" {
                off = got / expected;
            }
            if off.abs() >= worst.abs() {
                (worst, error_at_worst) = (off, error);
            }
        }
        let (most, difference) = match (first, second) {
            ("at", _) => (words.get(2).copied().unwrap_or(""), format!("x {worst:.4}")),
            (most, "SE") => (most, format!("{worst:+.2} SE")),
            (most, _) => (most, format!("{worst:+.3} %")),
        };
        let is_good = !is_missing && most.parse().is_ok_and(|most: f64| worst.abs() <= most);
        Self {
            known: knowns.join(" "),
            found: founds.join(" "),
            difference: if is_missing { "missing".into() } else { difference },
            error_at_worst,
            is_by_errors: second == "SE",
            is_missing,
            is_good,
        }
    }
}
