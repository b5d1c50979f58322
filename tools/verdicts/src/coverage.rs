//! Do intervals hold the truth as often as they say?

use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use std::fmt::Write as _;

/// Shows what `make coverage` found, in percent of the truth. It does not hold if a row is missing, intervals hold the truth
/// less often than in 93 of 100 samples, or are more than 1.3 times as wide as need be.
pub(crate) const COVERAGE: Derivation = Derivation {
    word: "coverage",
    help: "How often intervals of samples hold the truth, and how much wider they are than need be",
    settings: &[],
    derive,
};

/// Rows that are wanted.
const ROWS: usize = 10;
const LEAST_COVERAGE: f64 = 0.93;
const MOST_WIDTH: f64 = 1.3;

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let mut text = String::new();
    let heads = [
        ["", "", "", "windows", "simulated", "", "mean", "in", "", "", "width over"],
        ["order", "rule", "truth", "", "share, %", "coverage, %", "+-, %", "doubt", "bias, %", "spread, %", "t spread"],
    ];
    for [order, rule, truth, windows, simulated, coverage, mean, doubt, bias, spread, width] in heads {
        let _ = writeln!(
            text,
            "{order:<14} {rule:<6} {truth:>7} {windows:>9} {simulated:>9} {coverage:>10} {mean:>7} {doubt:>7} {bias:>7} {spread:>9} {width:>9}"
        );
    }
    let (mut rows, mut bad) = (0, String::new());
    for row in asked.table(0)?.rows() {
        rows += 1;
        let percent = |name: &str| Ok::<f64, ReportError>(100.0 * row.number(name)?);
        let (order, rule) = (row.text("order")?, row.text("rule")?);
        let _ = writeln!(
            text,
            "{order:<14} {rule:<6} {:>7.2} {:>9.1} {:>9.2} {:>11.1} {:>7.2} {:>7.2} {:>7.2} {:>9.2} {:>10.2}",
            row.number("truth")?,
            row.number("windows")?,
            percent("sampled_share")?,
            percent("coverage")?,
            percent("mean_half_width")?,
            percent("mean_doubt")?,
            percent("bias")?,
            percent("spread")?,
            row.number("ratio")?
        );
        if row.number("coverage")? < LEAST_COVERAGE {
            bad += &format!(" {order}/{rule} (held too seldom)");
        }
        if row.number("ratio")? > MOST_WIDTH {
            bad += &format!(" {order}/{rule} (too wide)");
        }
    }
    let fault = match rows {
        rows if rows < ROWS => Some(format!("{ROWS} rows are wanted, there are {rows}")),
        _ if !bad.is_empty() => Some(format!("intervals do not hold:{bad}")),
        _ => None,
    };
    Ok(Derived { text, fault })
}
