//! What a number of ours has to be for a claim to be right.

use std::str::FromStr;

/// What a number of ours has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    /// `<= x`
    AtMost(f64),
    /// `>= x`
    AtLeast(f64),
    /// `within F`: the claimed number, a factor F at most either way.
    Within(f64),
    /// `a..b`, both included.
    Between(f64, f64),
    /// `none`: nothing is decided, and a reason says why.
    None,
}

impl Rule {
    /// Whether a number is such as the rule says, beside the number that is claimed.
    pub(super) fn holds(self, value: f64, claimed: f64) -> bool {
        match self {
            Self::AtMost(most) => value <= most,
            Self::AtLeast(least) => value >= least,
            Self::Within(factor) => value <= claimed * factor && value >= claimed / factor,
            Self::Between(least, most) => value >= least && value <= most,
            Self::None => false,
        }
    }
}

impl FromStr for Rule {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| pm_report::sheet::number(text.trim());
        let rule = match text.split_once(' ') {
            _ if text == "none" => Some(Self::None),
            Some(("<=", most)) => number(most).map(Self::AtMost),
            Some((">=", least)) => number(least).map(Self::AtLeast),
            Some(("within", factor)) => number(factor).map(Self::Within),
            _ => text.split_once("..").and_then(|(least, most)| Some(Self::Between(number(least)?, number(most)?))),
        };
        rule.ok_or_else(|| format!("`{text}` is no rule; there are `<= x`, `>= x`, `within F`, `a..b` and `none`"))
    }
}
