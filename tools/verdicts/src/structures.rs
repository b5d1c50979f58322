//! Every map under every order.

use crate::table::Row;
use crate::{Asked, Derivation, Derived, Table};
use pm_report::ReportError;
use pm_sweep::significant;
use std::fmt::Write as _;

/// The paper's Table 1 from the joined rows of structures.csv, at lines of 128 bytes: in fetches and bytes per query and in
/// fetches per block, with half the width of the interval where there is one.
pub(crate) const STRUCTURES: Derivation = Derivation {
    word: "structures",
    help: "Every map under every order at lines of 128 bytes; of hilbert one query in `share`",
    settings: &["share"],
    derive,
};

const ORDERS: [&str; 6] = ["scanline", "binned", "binned-hashed", "tiled-hilbert", "hilbert", "random"];

const PAPER: &str = "\
The paper, fetches per block: naive 23,045 kd, 11,755 kdB, 73,523 block hashing; tiled direction-binned 3,927, 4,397,
20,316; with hash 2,590, 2,870, 9,912; tiled Hilbert 1,215, 1,134, 2,350; Hilbert 1.6, 1.8, 3.1.
";

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let table = asked.table(0)?;
    let share: u64 = asked.needed("share")?;
    let mut text = format!(
        "Windows, but of hilbert one query in {share} of the sorted stream, dearer per query, not per block;\n\
         of random one in 512, which are as dear as all.\n\n"
    );
    let parts = [
        ("Fetches per query, lines of 128 bytes, cache of 128 KiB:", "fetches_per_query", 6),
        ("Bytes fetched per query:", "bytes_per_query", 6),
        (
            "Fetches per block of the map. Maps differ in blocks, so columns compare and rows do not:",
            "fetches_per_block",
            5,
        ),
    ];
    for (title, column, orders) in parts {
        let _ = writeln!(text, "{title}\n{}", part(table, column, &ORDERS[..orders])?);
    }
    Ok((text + PAPER).into())
}

fn part(table: &Table, column: &str, orders: &[&str]) -> Result<String, ReportError> {
    let mut at_128 = vec![];
    let mut maps: Vec<&str> = vec![];
    for row in table.rows() {
        if row.number("line")? == 128.0 {
            at_128.push((row.text("map")?, row.text("order")?, row));
            if !maps.contains(&row.text("map")?) {
                maps.push(row.text("map")?);
            }
        }
    }
    let line = |name: &str, cells: Vec<String>| {
        let cells = cells.iter().map(|cell| format!(" {cell:>18}"));
        format!("{name:<16}{}\n", cells.collect::<String>())
    };
    let mut text = line("map", orders.iter().map(|&order| order.to_owned()).collect());
    for map in maps {
        let cell = |order: &&str| {
            let row = at_128.iter().rev().find(|(of_map, of_order, _)| (of_map, of_order) == (&map, order));
            row.map_or(Ok("-".to_owned()), |(_, _, row)| Ok(told(row.number(column)?, half(*row)?)))
        };
        text += &line(map, orders.iter().map(cell).collect::<Result<Vec<_>, ReportError>>()?);
    }
    Ok(text)
}

/// Half the width of the interval of fetches per query, in percent.
fn half(row: Row<'_>) -> Result<f64, ReportError> {
    let fetches = row.number("fetches_per_query")?;
    Ok(if fetches > 0.0 { 100.0 * row.number("fetches_per_query_error")? / fetches } else { 0.0 })
}

fn told(value: f64, half: f64) -> String {
    let value = if value < 1000.0 { significant(value, 4) } else { format!("{value:.0}") };
    if half > 0.0 { format!("{value} +-{half:.1}%") } else { value }
}
