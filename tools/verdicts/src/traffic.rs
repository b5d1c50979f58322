//! All traffic of the orders.

use crate::table::Row;
use crate::{Asked, Derivation, Derived, Table};
use pm_report::ReportError;
use std::fmt::Write as _;

/// All traffic of the orders, with the paper's cache of 128 KiB.
pub(crate) const TRAFFIC: Derivation = Derivation {
    word: "traffic",
    help: "All traffic of the orders, with the paper's cache of 128 KiB",
    settings: &[],
    derive,
};

/// Bytes of the paper's cache.
const PAPER_CACHE: f64 = 131_072.0;

/// The rows of the paper's cache.
pub(crate) fn of_papers_cache(table: &Table) -> Result<Vec<Row<'_>>, ReportError> {
    let mut rows = vec![];
    for row in table.rows() {
        if row.number("cache_bytes")? == PAPER_CACHE {
            rows.push(row);
        }
    }
    Ok(rows)
}

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let mut text = String::new();
    let mut first = None;
    for row in of_papers_cache(asked.table(0)?)? {
        let total = row.number("total_bytes")?;
        if first.is_none() {
            let heads = ["", "order, MB", "", "queries,", "", "", "share of"];
            let names = ["order", "on chip", "map, GB", "GB", "results, GB", "total, GB", "scanline"];
            text += "\n";
            for [name, a, b, c, d, e, share] in [heads, names] {
                let _ = writeln!(text, "{name:<18} {a:>11} {b:>11} {c:>11} {d:>11} {e:>11} {share:>9}");
            }
        }
        let first = *first.get_or_insert(total);
        let _ = writeln!(
            text,
            "{:<18} {:>11.3} {:>11.3} {:>11.3} {:>11.3} {:>11.3} {:>9}",
            row.text("point")?,
            row.number("order_bytes_on_chip")? / 1e6,
            (row.number("bytes_fetched")? + row.number("bytes_written_back")?) / 1e9,
            row.number("query_bytes")? / 1e9,
            row.number("result_bytes")? / 1e9,
            total / 1e9,
            share(total, first)
        );
    }
    Ok(text.into())
}

/// A part of a whole: `1/3.4` where it is less than half.
pub(crate) fn share(part: f64, whole: f64) -> String {
    if 2.0 * part < whole { format!("1/{:.1}", whole / part) } else { format!("{:.3}", part / whole) }
}
