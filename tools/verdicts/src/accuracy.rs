//! What was found beside what is known, and whether it is near enough.
//!
//! A table of what is known has the columns `experiment`, `part` (a name, or a rectangle `x0 y0 x1 y1`, less another after a
//! minus), `what` (it is), `r`, `g`, `b` (the values; `=EXPERIMENT` in `r`: those of the same part of another), `se_r`, `se_g`,
//! `se_b` (their standard errors) and `tolerance`: `1 %`, `3 SE` (standard errors of the difference), or `at most 0.5` of it.
//! What was found is in a table for each experiment, named after it.

mod judged;
mod known;
mod tolerance;

use crate::measured::{Measured, read};
use crate::{Asked, Derivation, Derived, Table};
use judged::Judged;
use known::Known;
use pm_report::ReportError;
use pm_sweep::significant;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// What experiments found beside what is known. It does not hold if something is not near enough, or not there.
pub(crate) const ACCURACY: Derivation = Derivation {
    word: "accuracy",
    help: "What experiments found beside what is known, and whether it is near enough",
    settings: &[],
    derive,
};

/// What was found: the parts of experiments.
#[derive(Clone, Debug, Default)]
struct Findings(BTreeMap<(String, String), Measured>);

impl Findings {
    /// Adds what was found in the experiment that a table is named after.
    fn add(&mut self, table: &Table) -> Result<(), ReportError> {
        for row in read(table.sheet())? {
            self.0.insert((table.stem().to_owned(), row.part.clone()), row);
        }
        Ok(())
    }

    /// A part of an experiment, if it was measured.
    fn part(&self, experiment: &str, part: &str) -> Option<&Measured> {
        self.0.get(&(experiment.to_owned(), part.to_owned()))
    }

    /// The value of a part, which may be one less another, in a channel.
    fn value(&self, experiment: &str, part: &str, channel: usize) -> Option<f64> {
        let Some((whole, hole)) = part.split_once(" - ") else { return self.part(experiment, part)?.value[channel] };
        let (whole, hole) = (self.part(experiment, whole)?, self.part(experiment, hole)?);
        let sum = whole.value[channel]? * whole.pixels - hole.value[channel]? * hole.pixels;
        Some(sum / (whole.pixels - hole.pixels))
    }
}

/// The rectangles of a picture that something is known of, such as `0,0,24,24`.
pub(crate) fn rectangles(known: &Table, experiment: &str) -> Result<Vec<String>, ReportError> {
    let of_it = Known::read(known)?.into_iter().filter(|known| known.experiment == experiment);
    Ok(of_it.flat_map(|known| known.part.split(" - ").map(|part| part.replace(' ', ",")).collect::<Vec<_>>()).collect())
}

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let mut findings = Findings::default();
    asked.tables.iter().skip(1).try_for_each(|table| findings.add(table))?;
    let head = ["scene and experiment", "known (r g b)", "found (r g b)", "difference", "tolerance", ""];
    let mut text = line(head);
    let (mut rows, mut bad, mut largest) = (0, 0, 0.0_f64);
    for known in Known::read(asked.table(0)?)? {
        let Judged { expected, found, difference, good, error } = Judged::new(&known, &findings);
        let verdict = if good { "ok" } else { "NOT OK" };
        text += &line([&known.what, &expected, &found, &difference, known.tolerance.text(), verdict]);
        rows += 1;
        bad += u32::from(!good);
        largest = largest.max(error.unwrap_or(0.0));
    }
    if largest > 0.0 {
        let largest = significant(largest, 2);
        let _ = writeln!(text, "\nStandard errors (SE) of the fluxes are at most {largest} of what is emitted.");
    }
    if rows == 0 || bad > 0 {
        let _ = writeln!(text, "{bad} of {rows} rows are NOT OK");
        return Ok(Derived { text, fault: Some(format!("{bad} of {rows} rows are not near enough to what is known")) });
    }
    let _ = writeln!(text, "all {rows} rows are ok");
    Ok(text.into())
}

fn line([what, known, found, difference, tolerance, verdict]: [&str; 6]) -> String {
    format!("{what:<46} {known:<27} {found:<27} {difference:>11}  {tolerance:<10} {verdict}\n")
}
