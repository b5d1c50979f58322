//! How near is near enough.

use std::str::FromStr;

/// How far what was found may be from what is known.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tolerance {
    pub(super) measure: Measure,
    /// The most that is good.
    pub(super) most: f64,
    /// As it is written.
    text: String,
}

/// In what a difference is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// `1 %`: of what is known.
    PerCent,
    /// `3 SE`: in standard errors of the difference.
    StandardErrors,
    /// `at most 0.5`: found over known.
    Ratio,
}

impl Measure {
    /// How far a number is from a known one; `error` is the standard error of the difference.
    pub(super) fn of(self, found: f64, known: f64, error: f64) -> f64 {
        match self {
            Self::PerCent => 100.0 * (found / known - 1.0),
            Self::StandardErrors => (found - known) / error,
            Self::Ratio => found / known,
        }
    }

    /// A difference as it is told.
    pub(super) fn told(self, difference: f64) -> String {
        match self {
            Self::PerCent => format!("{difference:+.3} %"),
            Self::StandardErrors => format!("{difference:+.2} SE"),
            Self::Ratio => format!("x {difference:.4}"),
        }
    }
}

impl FromStr for Tolerance {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let words: Vec<&str> = text.split(' ').collect();
        let (measure, most) = match words[..] {
            [most, "%"] => (Measure::PerCent, most),
            [most, "SE"] => (Measure::StandardErrors, most),
            ["at", "most", most] => (Measure::Ratio, most),
            _ => (Measure::PerCent, ""),
        };
        let wrong = || format!("`{text}` is no tolerance; there are `1 %`, `3 SE` and `at most 0.5`");
        let most = pm_report::sheet::number(most).ok_or_else(wrong)?;
        Ok(Self { measure, most, text: text.to_owned() })
    }
}

impl Tolerance {
    /// As it is written.
    pub(super) fn text(&self) -> &str {
        &self.text
    }
}
