//! Whether a claim is right, by our number, its interval and the rule.

use super::Rule;
use pm_report::ReportError;
use pm_report::expression::{Found, Place};
use pm_report::sheet::number;
use pm_sweep::significant;

pm_registry::choices! {
    /// What comes of a claim.
    #[derive(Debug)]
    pub(super) enum Verdict {
        /// Ours is as the rule says, wherever in its interval it lies
        Confirmed = "confirmed",
        /// Ours is not, wherever it lies
        NotConfirmed = "not confirmed",
        /// A limit lies within the interval, or nothing was measured
        Undecided = "cannot be decided",
    }
}

/// A claim beside our number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Judged {
    verdict: Verdict,
    /// Ours and half the width of its interval, if there is one.
    ours: Option<(f64, Option<f64>)>,
    /// The number that is claimed.
    claimed: Option<f64>,
}

impl Judged {
    /// Nothing was measured.
    pub(super) const fn undecided() -> Self {
        Self { verdict: Verdict::Undecided, ours: None, claimed: None }
    }

    /// What a rule says of a value that was found.
    ///
    /// # Errors
    /// If it is no number.
    pub(super) fn new(found: &Found, claimed: Option<f64>, rule: Rule) -> Result<Self, ReportError> {
        let value = found.number.ok_or_else(|| ReportError::asked(format!("`{}` is not a number", found.text)))?;
        // Relative half widths of independent estimates add up in squares.
        let doubt: f64 = found.places.iter().map(|place| relative_half_width(place).powi(2)).sum();
        let half = value * doubt.sqrt();
        let holds = |value: f64| rule.holds(value, claimed.unwrap_or(0.0));
        let verdict = match (holds(value - half), holds(value + half)) {
            (true, true) => Verdict::Confirmed,
            (false, false) if !holds(value) => Verdict::NotConfirmed,
            _ => Verdict::Undecided,
        };
        Ok(Self { verdict, ours: Some((value, (doubt > 0.0).then_some(half))), claimed })
    }

    /// Whether the claim is right.
    pub(super) const fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Whether nothing is decided because a limit lies within the interval.
    pub(super) fn within_interval(&self) -> bool {
        self.ours.is_some() && self.verdict == Verdict::Undecided
    }

    /// Our number as it is written, with half the width of its interval.
    pub(super) fn ours(&self) -> String {
        self.ours.map_or(String::new(), |(value, half)| {
            significant(value, 4) + &half.map_or(String::new(), |half| format!(" ± {}", significant(half, 2)))
        })
    }

    /// Our number over the claimed one.
    pub(super) fn ratio(&self) -> String {
        let claimed = self.claimed.filter(|claimed| *claimed != 0.0);
        self.ours.zip(claimed).map_or(String::new(), |((value, _), claimed)| significant(value / claimed, 3))
    }
}

/// Half the width of the interval around a number over the number itself; 0 of what is known in full.
fn relative_half_width(place: &Place) -> f64 {
    let half = place.beside(&format!("{}_error", place.column())).and_then(number);
    match (number(place.field()), half) {
        (Some(value), Some(half)) if value != 0.0 => half / value,
        _ => 0.0,
    }
}
