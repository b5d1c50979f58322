//! The orders beside each other and beside the paper.

use crate::derivation::fail;
use crate::table::Row;
use crate::traffic::{of_papers_cache, share};
use crate::{Asked, Derivation, Derived, Table};
use pm_report::ReportError;
use std::fmt::Write as _;

/// Sets the orders beside each other and beside the paper.
///
/// The first table holds the paper's figures, the others are what `pm-cachesim --format csv` prints, named after the order,
/// or a table of such rows with a column `point`. Of several caches the paper's own counts, of 128 KiB.
///
/// The paper: Steinhurst, Coombe, Lastra, *Reordering for Cache Conscious Photon Mapping*, GI 2005. Its fetches per query are
/// 196 GB (or GiB) over 128 bytes and 512 x 512 x 100 rays; its fetches per block and tile are Table 1 over 1,024.
pub(crate) const COMPARE: Derivation = Derivation {
    word: "compare",
    help: "The orders beside each other and the paper, in an image of `size` pixels with so many `gathers` each",
    settings: &["size", "gathers"],
    derive,
};

/// Pixels along the side of a tile.
const TILE: u64 = 16;

/// The order of the paper's figures.
const PLAIN: &str = "scanline";

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let size: String = asked.needed("size")?;
    let sides = size.split_once('x').and_then(|(w, h)| Some((w.parse::<u64>().ok()?, h.parse::<u64>().ok()?)));
    let Some((width, height)) = sides else { return fail(format!("size={size} is no WIDTHxHEIGHT")) };
    let rays = width * height * asked.needed::<u64>("gathers")?;
    let tiles = width.div_ceil(TILE) * height.div_ceil(TILE);
    let (paper, results) = (asked.table(0)?, asked.tables.get(1..).unwrap_or_default());
    let mut text = heads();
    let (mut whole, mut queries, mut with_rows) = (None, 0.0, 0);
    for table in results {
        let rows = of_papers_cache(table)?;
        with_rows += usize::from(!rows.is_empty());
        for row in rows {
            let name = row.if_any("point").unwrap_or(table.stem());
            queries = row.number("queries")?;
            if name == PLAIN {
                whole = Some((row.number("bytes_fetched")? / 1e6, row.number("fetches")?));
            }
            text += &line(name, row, paper, tiles as f64, whole.map(|(mb, _)| mb))?;
        }
    }
    // A row that is missing means a command that did not do its work, whatever exit code it gave.
    if with_rows != results.len() {
        let wanted = results.len();
        return fail(format!(
            "{wanted} results are wanted, {with_rows} have a row; remove the empty ones and run again"
        ));
    }
    if queries > 0.0 {
        let _ = writeln!(
            text,
            "\n{queries} queries of {rays} gather rays: the others left through the open front or met only black surfaces."
        );
        if let Some((_, fetches)) = whole {
            let divided = fetches / rays as f64;
            let _ = writeln!(text, "The paper divides by all rays; so divided scanline has {divided:.1} fetches.");
        }
    }
    Ok(text.into())
}

fn heads() -> String {
    format!(
        "{:<18} {:>9} {:>9} {:>11} {:>12} {:>12}\n{:<18} {:>9} {:>9} {:>11} {:>12} {:>12}   {:<34} {}\n",
        "",
        "reads",
        "fetches",
        "fetches",
        "",
        "share of",
        "order",
        "per query",
        "per query",
        "per block",
        "MB",
        PLAIN,
        "in the paper's unit",
        "paper"
    )
}

fn line(name: &str, row: Row<'_>, paper: &Table, tiles: f64, whole: Option<f64>) -> Result<String, ReportError> {
    let base = ["-inf", "-preorder", "-reread"].iter().find_map(|ending| name.strip_suffix(ending)).unwrap_or(name);
    let of_paper = paper.rows().find(|row| row.if_any("order") == Some(base));
    let unit = of_paper.map_or(Ok(""), |row| row.text("unit"))?;
    let (per_query, per_block) = (row.number("fetches_per_query")?, row.number("fetches_per_block")?);
    let unit = match base {
        "random" if unit.is_empty() => "fetches per query",
        "tiled" if unit.is_empty() => "fetches per block and tile",
        _ => unit,
    };
    let own = match unit {
        "fetches per query" => format!("{per_query:.1} {unit}"),
        "fetches per block" => format!("{per_block:.2} {unit}"),
        "fetches per block and tile" => format!("{:.2} {unit}", per_block / tiles),
        _ => String::new(),
    };
    let mb = row.number("bytes_fetched")? / 1e6;
    let share = whole.map_or("-".to_owned(), |whole| share(mb, whole));
    Ok(format!(
        "{name:<18} {:>9.1} {per_query:>9.3} {per_block:>11.2} {mb:>12.1} {share:>12}   {own:<34} {}\n",
        row.number("reads_per_query")?,
        of_paper.map_or(Ok("-"), |row| row.text("value"))?
    ))
}
