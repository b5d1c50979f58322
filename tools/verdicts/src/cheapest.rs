//! What an accuracy costs at least.

use crate::{Asked, Derivation, Derived, VerdictError};
use std::fmt::Write as _;

/// For an error of at most so much, the setting that takes the fewest seconds and the one that fetches the fewest bytes.
pub(crate) const CHEAPEST: Derivation = Derivation {
    word: "cheapest",
    help: "For an error of at most so much, the settings with the fewest seconds and the fewest bytes",
    settings: &[],
    derive,
};

const LIMITS: [&str; 5] = ["0.03", "0.01", "0.003", "0.001", "0.0003"];
const SHOWN: [&str; 9] = ["method", "setting", "n", "k", "gathers", "seconds", "bytes_fetched", "rel_mse", "ldr_flip"];

fn derive(asked: &Asked<'_>) -> Result<Derived, VerdictError> {
    let table = asked.table(0)?;
    let mut text = format!("rel_mse_at_most,by,{}\n", SHOWN.join(","));
    for limit in LIMITS {
        let most: f64 = limit.parse().expect("a number");
        for (by, column) in [("seconds", "seconds"), ("bytes", "bytes_fetched")] {
            let enough = table.rows().filter(|row| row.number("rel_mse") <= most);
            // The first of equals.
            let least = enough.reduce(|a, b| if b.number(column) < a.number(column) { b } else { a });
            let said = least
                .map_or("none of those tried,,,,,,,,".to_owned(), |row| SHOWN.map(|name| row.text(name)).join(","));
            let _ = writeln!(text, "{limit},{by},{said}");
        }
    }
    Ok(text.into())
}
