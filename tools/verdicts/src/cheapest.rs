//! What an accuracy costs at least.

use crate::table::{Row, csv};
use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;

/// For an error of at most so much, the setting that takes the fewest seconds and the one that fetches the fewest bytes.
pub(crate) const CHEAPEST: Derivation = Derivation {
    word: "cheapest",
    help: "For an error of at most so much, the settings with the fewest seconds and the fewest bytes",
    settings: &[],
    derive,
};

const LIMITS: [&str; 5] = ["0.03", "0.01", "0.003", "0.001", "0.0003"];
const SHOWN: [&str; 9] = ["method", "setting", "n", "k", "gathers", "seconds", "bytes_fetched", "rel_mse", "ldr_flip"];

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let table = asked.table(0)?;
    let mut rows = vec![];
    for limit in LIMITS {
        let most: f64 = limit.parse().expect("a number");
        for (by, column) in [("seconds", "seconds"), ("bytes", "bytes_fetched")] {
            let mut least: Option<(f64, Row<'_>)> = None;
            for row in table.rows() {
                let cost = row.number(column)?;
                // The first of equals.
                if row.number("rel_mse")? <= most && least.is_none_or(|(other, _)| cost < other) {
                    least = Some((cost, row));
                }
            }
            let mut cells = [limit, by, "none of those tried", "", "", "", "", "", "", "", ""].map(str::to_owned);
            if let Some((_, row)) = least {
                for (cell, name) in cells[2..].iter_mut().zip(SHOWN) {
                    row.text(name)?.clone_into(cell);
                }
            }
            rows.push(cells);
        }
    }
    let [method, setting, n, k, gathers, seconds, bytes, error, flip] = SHOWN;
    let names = ["rel_mse_at_most", "by", method, setting, n, k, gathers, seconds, bytes, error, flip];
    Ok(csv(names, rows).into())
}
