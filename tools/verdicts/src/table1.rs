//! The paper's Table 1.

use crate::table::{Row, csv};
use crate::{Asked, Derivation, Derived, Table};
use pm_report::ReportError;
use pm_sweep::significant;
use std::collections::HashMap;

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

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let (paper, ours) = (Blocks::of(asked.table(0)?)?, Blocks::of(asked.table(1)?)?);
    let mut rows = vec![];
    for row in asked.table(1)?.rows() {
        let [order, map, found] = [row.text("order")?, row.text("map")?, row.text("found")?];
        let blocks = ours.number(order, map).unwrap_or(f64::NAN);
        let share = blocks / ours.number(PLAIN, map).unwrap_or(f64::NAN);
        let theirs = paper.number(order, map).zip(paper.number(PLAIN, map)).map(|(own, plain)| own / plain);
        rows.push([
            order.to_owned(),
            map.to_owned(),
            found.to_owned(),
            row.if_any("queries_simulated").map_or_else(|| row.text("queries"), Ok)?.to_owned(),
            row.text("fetches_per_query")?.to_owned(),
            row.text("fetches_per_query_error")?.to_owned(),
            significant(blocks, 5),
            significant(share, 4),
            theirs.and(paper.text(order, map)).unwrap_or_default().to_owned(),
            theirs.map_or(String::new(), |theirs| significant(theirs, 4)),
            theirs.map_or(String::new(), |theirs| significant(share / theirs, 3)),
            row.text("history")?.to_owned(),
        ]);
    }
    Ok(csv(NAMES, rows).into())
}

/// The order whose share all have.
const PLAIN: &str = "scanline";

const NAMES: [&str; 12] = [
    "order",
    "map",
    "found",
    "queries_simulated",
    "fetches_per_query",
    "fetches_per_query_error",
    "fetches_per_block",
    "share_of_scanline",
    "paper_fetches_per_block",
    "paper_share_of_scanline",
    "ratio",
    "history",
];

/// Fetches per block by order and map: as the table has them, and of the whole.
struct Blocks<'a>(HashMap<(&'a str, &'a str), (&'a str, f64)>);

impl<'a> Blocks<'a> {
    fn of(table: &'a Table) -> Result<Self, ReportError> {
        let blocks = |row: Row<'a>| {
            let (order, map) = (row.text("order")?, row.text("map")?);
            let is_thinned = order == "random" && row.if_any("found") == Some("thinned");
            let whole = row.number("fetches_per_block")? * if is_thinned { THINNED } else { 1.0 };
            Ok(((order, map), (row.text("fetches_per_block")?, whole)))
        };
        Ok(Self(table.rows().map(blocks).collect::<Result<_, ReportError>>()?))
    }

    fn number(&self, order: &str, map: &str) -> Option<f64> {
        self.0.get(&(order, map)).map(|(_, number)| *number)
    }

    fn text(&self, order: &str, map: &str) -> Option<&'a str> {
        self.0.get(&(order, map)).map(|(text, _)| *text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::derived;

    #[test]
    fn what_is_thinned_stands_for_all_and_maps_are_compared_by_their_shares() {
        let paper = "order,map,fetches_per_block\nscanline,kd,20000\nhilbert,kd,2.0\n";
        let ours = "order,map,found,queries,queries_simulated,fetches_per_query,fetches_per_query_error,fetches_per_block,history\n\
            scanline,kd,sampled,99,33,70.5,1.25,10000,\"a, b\"\nhilbert,kd,full,99,,1,,4,x\nrandom,kd,thinned,5,,2,,30,y\n";
        let text = derived(&TABLE_1, &[("paper.csv", paper), ("table1.csv", ours)], &[]).unwrap().text;
        let rows: Vec<&str> = text.lines().skip(1).collect();
        assert_eq!(rows[0], "scanline,kd,sampled,33,70.5,1.25,10000,1,20000,1,1,\"a, b\"");
        assert_eq!(rows[1], "hilbert,kd,full,99,1,,4,0.0004,2.0,0.0001,4,x");
        assert_eq!(rows[2], "random,kd,thinned,5,2,,15360,1.536,,,,y");
    }
}
