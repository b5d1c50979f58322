//! Sentences that can be tested, beside our results, and what comes of them.
//!
//! A table of claims has the columns `id`, `section`, `claim`, `unit`, `paper` (the number that is claimed, if there is one),
//! `ours` (an [expression](pm_report::expression) of results: `point('table1/scanline.kd').fetches_per_query` is a column of
//! the row of a point of a sweep), `rule` (what ours has to be) and `reason` (why nothing is decided). A number that was
//! sampled has half the width of its interval beside it, in the column of the same name and `_error`. Where a limit lies
//! within the interval, nothing is decided.

mod rule;
mod verdict;

use crate::table::{Row, csv};
use crate::{Asked, Derivation, Derived, Table};
use pm_registry::Choice as _;
use pm_report::ReportError;
use pm_report::expression::{Evaluator, Names, names_asked};
use rule::Rule;
use verdict::Judged;

/// The sentences beside our results: the verdicts as CSV, or with `list` the files of results that they need.
pub(crate) const CLAIMS: Derivation = Derivation {
    word: "claims",
    help: "The paper's sentences beside our results, as CSV; or with `list` the files of results that they need",
    settings: &["list"],
    derive,
};

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let claims = Claim::read(asked.table(0)?)?;
    if asked.settings.contains_key("list") {
        return Ok(files(&claims)?.iter().map(|file| format!("{file}\n")).collect::<String>().into());
    }
    let evaluator = Evaluator::new(asked.results, Names::new()).with_rows(POINT, asked.results, file_of_point);
    let verdicts = claims.iter().map(|claim| Ok(claim.cells(&claim.judge(&evaluator)?)));
    Ok(csv(NAMES, verdicts.collect::<Result<Vec<_>, ReportError>>()?).into())
}

/// The columns of the table of verdicts.
const NAMES: [&str; 11] =
    ["id", "section", "claim", "unit", "paper", "ours", "ratio", "rule", "verdict", "reason", "how"];

/// The function that says which point of a sweep.
const POINT: &str = "point";

/// The file of a point of a sweep, such as `table1/scanline.kd`.
fn file_of_point(name: &str) -> String {
    format!("out/{name}.csv")
}

/// The files of results that claims need, each once, in the order in which they are needed.
fn files(claims: &[Claim<'_>]) -> Result<Vec<String>, ReportError> {
    let mut files: Vec<String> = vec![];
    for claim in claims.iter().filter(|claim| claim.rule != Rule::None) {
        let names = names_asked(claim.ours, POINT).map_err(|error| claim.row.wrong(error))?;
        for file in names.iter().map(|name| file_of_point(name)) {
            if !files.contains(&file) {
                files.push(file);
            }
        }
    }
    Ok(files)
}

/// A sentence that can be tested.
struct Claim<'a> {
    row: Row<'a>,
    /// Its id, section, text, unit and number as they are written.
    front: [&'a str; 5],
    /// The number that is claimed, if there is one.
    paper: Option<f64>,
    /// What ours is, as an expression.
    ours: &'a str,
    rule: Rule,
    reason: &'a str,
}

impl<'a> Claim<'a> {
    /// The claims of a table.
    ///
    /// # Errors
    /// If a column is missing, or a claim is not such as can be tested.
    fn read(table: &'a Table) -> Result<Vec<Self>, ReportError> {
        table.rows().map(Self::new).collect()
    }

    fn new(row: Row<'a>) -> Result<Self, ReportError> {
        let text = |name| row.text(name);
        let claim = Self {
            row,
            front: [text("id")?, text("section")?, text("claim")?, text("unit")?, text("paper")?],
            paper: row.if_any("paper").map(|_| row.number("paper")).transpose()?,
            ours: text("ours")?,
            rule: text("rule")?.parse().map_err(|error: String| row.wrong(error))?,
            reason: text("reason")?,
        };
        match claim.rule {
            Rule::None if claim.reason.is_empty() => Err(row.wrong("a claim that is not decided needs a reason")),
            _ => Ok(claim),
        }
    }

    /// What comes of it.
    fn judge(&self, evaluator: &Evaluator) -> Result<Judged, ReportError> {
        if self.rule == Rule::None {
            return Ok(Judged::undecided());
        }
        let found = evaluator.evaluate(self.ours);
        found.and_then(|found| Judged::new(&found, self.paper, self.rule)).map_err(|error| self.row.wrong(error))
    }

    /// Its row in the table of verdicts.
    fn cells(&self, judged: &Judged) -> [String; NAMES.len()] {
        let [id, section, claim, unit, paper] = self.front;
        let reason = if judged.within_interval() { "the limit lies within the interval" } else { self.reason };
        let (number, ratio, verdict) = (judged.ours(), judged.ratio(), judged.verdict().word());
        let rule = self.row.if_any("rule").unwrap_or_default();
        [id, section, claim, unit, paper, &number, &ratio, rule, verdict, reason, self.ours].map(str::to_owned)
    }
}

#[cfg(test)]
mod tests;
