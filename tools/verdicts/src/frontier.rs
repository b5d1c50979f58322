//! The points of the frontier: bytes on chip against all traffic.

use crate::{Asked, Derivation, Derived, Table, VerdictError};
use std::collections::HashSet;

/// From joined rows of sweeps (what is simulated in full first) to the points of the frontier.
///
/// On chip is the cache, what the order needs and the cache of results. A cache larger than the map holds the map; of those
/// only the least is kept. What is thinned (one query in so many of a sorted stream) is multiplied as if searches shared
/// nothing but the first touch of a line, so that its map and result traffic are at most so large. `best` is a point that no
/// other of its series, with the same record, beats on both axes. What an earlier table has in full, with the same photons,
/// is not taken from a later one, nor is what is thinned of an order that it has.
pub(crate) const FRONTIER: Derivation = Derivation {
    word: "frontier",
    help: "The points of the frontier, of joined rows: bytes on chip against all traffic",
    settings: &[],
    derive,
};

/// Bytes of the cache of results.
const RESULTS: f64 = 16_384.0;

const NAMES: &str = "photons,series,record,point,share,found,cache_bytes,order_bytes,on_chip_bytes,map_bytes,query_bytes,\
                     result_bytes,total_bytes,best";

/// Who a point is.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Name {
    photons: String,
    series: String,
    record: String,
    point: String,
}

#[derive(Clone)]
struct Point {
    name: Name,
    /// Share, how it was found, bytes of the cache and of the order, as the rows have them.
    given: String,
    on_chip: f64,
    /// Map, queries, results.
    parts: [f64; 3],
    total: f64,
}

/// What a table in full has: points, and the series they are of.
type InFull = HashSet<(String, String, String, Option<String>)>;

fn derive(asked: &Asked<'_>) -> Result<Derived, VerdictError> {
    let mut points = vec![];
    let mut in_full = InFull::new();
    for (at, table) in asked.tables.iter().enumerate() {
        collect(table, at == 0, &mut in_full, &mut points);
    }
    let mut text = NAMES.to_owned() + "\n";
    for point in &points {
        let of_series = |other: &&Point| {
            other.name.photons == point.name.photons
                && other.name.series == point.name.series
                && other.name.record == point.name.record
        };
        let beats = |other: &Point| {
            other.on_chip <= point.on_chip
                && other.total <= point.total
                && (other.on_chip < point.on_chip || other.total < point.total)
        };
        let best = !points.iter().filter(of_series).any(beats);
        text += &line(point, &point.name.record, best);
        // What stores no queries stands beside both kinds of records.
        if ["scanline", HELD].contains(&&*point.name.series) && point.name.record == "full" {
            text += &line(point, "compact", best);
        }
    }
    Ok(text.into())
}

/// The series of caches that hold the map.
const HELD: &str = "cache holds the map";

fn line(point: &Point, record: &str, best: bool) -> String {
    let Point { name, given, on_chip, parts: [map, query, result], total } = point;
    let Name { photons, series, point, .. } = name;
    let best = if best { "yes" } else { "no" };
    format!(
        "{photons},{series},{record},{point},{given},{on_chip:.0},{map:.0},{query:.0},{result:.0},{total:.0},{best}\n"
    )
}

fn collect(table: &Table, is_first: bool, in_full: &mut InFull, points: &mut Vec<Point>) {
    let (mut holds, mut last) = (false, None);
    for row in table.rows() {
        if table.has("start") && row.text("start") != "auto" || table.has("map") && row.text("map") != "kd" {
            continue;
        }
        let series = row.text("order");
        let photons = if table.has("n") { row.text("n") } else { "450000" };
        let mut point = series.to_owned();
        for part in [row.text("tile"), row.text("store")].into_iter().filter(|part| !part.is_empty()) {
            point = point + "-" + part;
        }
        let name = Name { photons: photons.into(), series: series.into(), record: row.text("record").into(), point };
        if last.as_ref() != Some(&name) {
            holds = false;
        }
        last = Some(name.clone());
        let of_all = (name.photons.clone(), name.series.clone(), name.record.clone(), None);
        let of_point = (name.photons.clone(), name.series.clone(), name.record.clone(), Some(name.point.clone()));
        if is_first {
            in_full.extend([of_all, of_point]);
        } else if in_full.contains(&of_point) || row.text("found") == "thinned" && in_full.contains(&of_all) {
            continue;
        }
        if holds {
            continue;
        }
        let point = traffic(row, name);
        holds = row.number("fetches") == row.number("compulsory");
        points.push(point.clone());
        if holds && series == "scanline" {
            points.push(Point { name: Name { series: HELD.into(), ..point.name.clone() }, ..point });
        }
    }
}

/// The traffic of the whole image, by the share of it that was simulated.
fn traffic(row: crate::table::Row<'_>, name: Name) -> Point {
    let share = row.text("share");
    let times: f64 = share.strip_prefix("1/").unwrap_or(share).parse().unwrap_or(0.0);
    // No line is fetched for the first time twice.
    let first = (row.number("compulsory") * times).min(row.number("blocks"));
    let again = (row.number("fetches") - row.number("compulsory")) * times;
    let map = (again + first) * row.number("line_bytes") + row.number("bytes_written_back") * times;
    let (query, result) = (row.number("query_bytes") * times, row.number("result_bytes") * times);
    Point {
        name,
        given: [share, row.text("found"), row.text("cache_bytes"), row.text("order_bytes_on_chip")].join(","),
        on_chip: row.number("cache_bytes") + row.number("order_bytes_on_chip") + RESULTS,
        parts: [map, query, result],
        total: map + query + result,
    }
}
