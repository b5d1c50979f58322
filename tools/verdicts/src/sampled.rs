//! How wide the intervals of samples are, and how far off the samples.

use crate::derivation::fail;
use crate::table::csv;
use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use pm_sweep::significant;
use std::collections::HashMap;

/// How wide the intervals of sampled rows are and how far they are from the row in full, both in percent, by the share of
/// the searches that are simulated.
pub(crate) const SAMPLED: Derivation = Derivation {
    word: "sampled",
    help: "How wide the intervals of sampled rows are and how far they are from the row in full, by what was simulated",
    settings: &[],
    derive,
};

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let mut full: HashMap<&str, (f64, f64)> = HashMap::new();
    let mut rows = vec![];
    for row in asked.table(0)?.rows() {
        let (order, found) = (row.text("order")?, row.number("fetches_per_query")?);
        if row.text("found")? == "full" {
            full.insert(order, (found, row.number("queries")?));
            continue;
        }
        let Some(&(truth, queries)) = full.get(order) else {
            return fail(format!("the row in full of {order} has to come first"));
        };
        let share = significant(row.number("queries_simulated")? / queries, 6);
        let interval = 100.0 * row.number("fetches_per_query_error")? / found;
        let error = 100.0 * (found - truth).abs() / truth;
        for (what, percent) in [("interval", interval), ("error", error)] {
            let every = row.text("every")?.to_owned();
            rows.push([order.to_owned(), what.to_owned(), every, share.clone(), significant(percent, 4)]);
        }
    }
    Ok(csv(["order", "what", "every", "share_simulated", "percent"], rows).into())
}
