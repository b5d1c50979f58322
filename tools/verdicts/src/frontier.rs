//! What all bytes on chip buy, in all bytes of traffic: the points of orders and caches, and which of them no other beats.
//!
//! On chip is the cache, what the order needs and the cache of results. A cache larger than the map holds the map; of those
//! only the least is kept. What is thinned (one query in so many of a sorted stream) is multiplied as if searches shared nothing
//! but the first touch of a line, so that its map and result traffic are at most so large. What an earlier table has in full,
//! with the same photons, is not taken from a later one, nor is what is thinned of an order that it has.

mod point;
mod rows;

use crate::table::csv;
use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use pm_report::chart::unbeaten;
use point::Point;
use rows::{Key, Row};
use std::collections::BTreeSet;

/// From joined rows of sweeps (what is simulated in full first) to the points of the frontier. `best` is a point that no other
/// of its series, with the same records, beats on both axes.
pub(crate) const FRONTIER: Derivation = Derivation {
    word: "frontier",
    help: "The points of the frontier, of joined rows: bytes on chip against all traffic",
    settings: &[],
    derive,
};

/// The series of caches that hold the whole map: no order matters to them.
pub(crate) const HOLDS_THE_MAP: &str = "cache holds the map";

/// The order that stores no queries.
const PLAIN: &str = "scanline";

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let mut points = vec![];
    let mut in_full: BTreeSet<Key> = BTreeSet::new();
    for (number, table) in asked.tables.iter().enumerate() {
        let rows = rows::read(table)?;
        let (mut last, mut holds) = (None, false);
        for row in &rows {
            if last != Some(&row.key) {
                holds = false;
            }
            last = Some(&row.key);
            let order = Key { point: None, ..row.key.clone() };
            if number == 0 {
                in_full.extend([row.key.clone(), order]);
            } else if in_full.contains(&row.key) || row.found == "thinned" && in_full.contains(&order) {
                continue;
            }
            if holds {
                continue;
            }
            holds = row.holds_the_map();
            points.push(Point::new(row, &row.key.series));
            if holds && row.key.series == PLAIN {
                points.push(Point::new(row, HOLDS_THE_MAP));
            }
        }
    }
    Ok(with_the_best(&points).into())
}

/// The table of points, and which of them are best.
fn with_the_best(points: &[Point]) -> String {
    let mut best = vec![false; points.len()];
    let groups: BTreeSet<[&str; 3]> = points.iter().map(Point::group).collect();
    for group in groups {
        let of_it: Vec<usize> = (0..points.len()).filter(|&at| points[at].group() == group).collect();
        let places: Vec<(f64, f64)> = of_it.iter().map(|&at| (points[at].on_chip, points[at].traffic())).collect();
        of_it.iter().zip(unbeaten(&places)).for_each(|(&at, unbeaten)| best[at] = unbeaten);
    }
    let mut rows = vec![];
    for (point, best) in points.iter().zip(best) {
        rows.push(point.cells(&point.record, best));
        // What stores no queries stands beside both kinds of records.
        if [PLAIN, HOLDS_THE_MAP].contains(&&*point.series) && point.record == "full" {
            rows.push(point.cells("compact", best));
        }
    }
    csv(point::COLUMNS, rows)
}

#[cfg(test)]
mod tests;
