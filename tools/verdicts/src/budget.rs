//! The cheapest point that a memory's bandwidth allows.

use crate::frontier::HOLDS_THE_MAP;
use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use std::fmt::Write as _;

/// The point with the fewest bytes on chip whose traffic fits a memory bandwidth, for each number of photons.
pub(crate) const BUDGET: Derivation = Derivation {
    word: "budget",
    help: "The point with the fewest bytes on chip within `budget` GB/s at `fps` frames a second",
    settings: &["budget", "fps"],
    derive,
};

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let (budget, fps): (f64, f64) = (asked.needed("budget")?, asked.needed("fps")?);
    let mut best: Vec<(String, Option<(f64, String)>)> = vec![];
    for row in asked.table(0)?.rows() {
        let photons = row.text("photons")?;
        if !best.iter().any(|(other, _)| other == photons) {
            best.push((photons.to_owned(), None));
        }
        let (on_chip, total) = (row.number("on_chip_bytes")?, row.number("total_bytes")?);
        if row.text("series")? == HOLDS_THE_MAP || total * fps > budget * 1e9 {
            continue;
        }
        let (_, least) = best.iter_mut().find(|(other, _)| other == photons).expect("just put there");
        if least.as_ref().is_none_or(|(bytes, _)| on_chip < *bytes) {
            let said = format!(
                "{}, {} records, a cache of {} bytes: {on_chip} bytes on chip, {:.3} GB a frame",
                row.text("point")?,
                row.text("record")?,
                row.text("cache_bytes")?,
                total / 1e9
            );
            *least = Some((on_chip, said));
        }
    }
    let mut text = String::new();
    for (photons, least) in best {
        let said = least.map_or("no point needs so little".to_owned(), |(_, said)| said);
        let _ = writeln!(text, "{photons} photons: {said}");
    }
    Ok(text.into())
}
