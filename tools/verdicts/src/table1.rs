//! The paper's Table 1.

use crate::table::quoted;
use crate::{Asked, Derivation, Derived, VerdictError};
use pm_sweep::significant;
use std::collections::HashMap;
use std::fmt::Write as _;

/// The paper's Table 1 beside ours.
///
/// Fetches per block compare between orders of one map, not between maps, which differ in blocks. So does the share of the
/// plain order, in which the paper's and ours can be compared. Of a thinned stream fetches per block are what holds for the
/// whole.
pub(crate) const TABLE_1: Derivation = Derivation {
    word: "table1",
    help: "The paper's Table 1, its own figures first, beside ours",
    settings: &[],
    derive,
};

/// One query in so many of a random order stands for all.
const THINNED: f64 = 512.0;

fn derive(asked: &Asked<'_>) -> Result<Derived, VerdictError> {
    let key = |row: crate::table::Row<'_>| (row.text("order").to_owned(), row.text("map").to_owned());
    let paper: HashMap<_, _> = asked.table(0)?.rows().map(|row| (key(row), row.text("fetches_per_block"))).collect();
    let blocks = |row: crate::table::Row<'_>| {
        let is_thinned = row.text("order") == "random" && row.text("found") == "thinned";
        row.number("fetches_per_block") * if is_thinned { THINNED } else { 1.0 }
    };
    let ours = asked.table(1)?;
    let plain: HashMap<&str, f64> =
        ours.rows().filter(|row| row.text("order") == "scanline").map(|row| (row.text("map"), blocks(row))).collect();
    let mut text = "order,map,found,queries_simulated,fetches_per_query,fetches_per_query_error,fetches_per_block,\
                    share_of_scanline,paper_fetches_per_block,paper_share_of_scanline,ratio,history\n"
        .to_owned();
    for row in ours.rows() {
        let (order, map) = key(row);
        let simulated = if row.text("queries_simulated").is_empty() { "queries" } else { "queries_simulated" };
        let share = blocks(row) / plain.get(&*map).copied().unwrap_or(f64::NAN);
        let front = ["order", "map", "found", simulated, "fetches_per_query", "fetches_per_query_error"]
            .map(|name| row.text(name));
        let _ = write!(text, "{},{},{},", front.join(","), significant(blocks(row), 5), significant(share, 4));
        if let (Some(own), Some(whole)) = (paper.get(&(order, map.clone())), paper.get(&("scanline".to_owned(), map))) {
            let number = |text: &str| text.parse().unwrap_or(f64::NAN);
            let paper_share: f64 = number(own) / number(whole);
            let _ = write!(text, "{own},{},{}", significant(paper_share, 4), significant(share / paper_share, 3));
        } else {
            text += ",,";
        }
        let _ = writeln!(text, ",{}", quoted(row.text("history")));
    }
    Ok(text.into())
}
