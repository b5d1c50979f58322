//! A known value beside what was found of it.

use super::Findings;
use super::known::{Known, Source};
use super::tolerance::Measure;
use pm_sweep::significant;

/// A known value beside what was found, as it is told.
#[derive(Clone, Debug)]
pub(super) struct Judged {
    pub(super) expected: String,
    pub(super) found: String,
    /// Of the worst channel.
    pub(super) difference: String,
    /// Is it there and near enough?
    pub(super) good: bool,
    /// The standard error of the worst channel, where it is measured in these.
    pub(super) error: Option<f64>,
}

impl Judged {
    pub(super) fn new(known: &Known, findings: &Findings) -> Self {
        let Known { experiment, part, tolerance, .. } = known;
        let measure = tolerance.measure;
        let (mut expected, mut found) = (vec![], vec![]);
        let (mut worst, mut error_at_worst, mut missing) = (0.0_f64, None, false);
        // A number of things has one channel only.
        for channel in 0..if part == "searches" { 1 } else { 3 } {
            let right = match &known.value {
                Source::Values(values) => values[channel],
                Source::Experiment(other) => findings.value(other, part, channel),
            };
            let got = findings.value(experiment, part, channel);
            expected.push(told(right));
            found.push(told(got));
            let theirs = findings.part(experiment, part).map_or(0.0, |part| part.error[channel]);
            let error = (theirs.powi(2) + known.error[channel].powi(2)).sqrt();
            let pair = right.zip(got).filter(|(right, _)| *right != 0.0);
            let pair = pair.filter(|_| measure != Measure::StandardErrors || error > 0.0);
            let Some((right, got)) = pair else {
                missing = true;
                continue;
            };
            let off = measure.of(got, right, error);
            if off.abs() >= worst.abs() {
                worst = off;
                error_at_worst = (measure == Measure::StandardErrors).then_some(error);
            }
        }
        Self {
            expected: expected.join(" "),
            found: found.join(" "),
            difference: if missing { "missing".to_owned() } else { measure.told(worst) },
            good: !missing && worst.abs() <= tolerance.most,
            error: error_at_worst.filter(|_| !missing),
        }
    }
}

fn told(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        Some(value) if value >= 1000.0 => format!("{value:.0}"),
        Some(value) => significant(value, 5),
    }
}
