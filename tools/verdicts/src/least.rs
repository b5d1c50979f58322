//! The least traffic that bytes on chip buy.

use crate::frontier::HOLDS_THE_MAP;
use crate::{Asked, Derivation, Derived};
use pm_report::ReportError;
use pm_report::sheet::number;
use std::fmt::Write as _;

/// The least traffic that bytes on chip buy, and the order that has it.
pub(crate) const LEAST: Derivation = Derivation {
    word: "least",
    help: "The least traffic that bytes on chip buy, and the order that has it",
    settings: &[],
    derive,
};

const SIZES: [(&str, f64); 6] = [
    ("256K", 262_144.0),
    ("512K", 524_288.0),
    ("1M", 1_048_576.0),
    ("2M", 2_097_152.0),
    ("4M", 4_194_304.0),
    ("8M", 8_388_608.0),
];

/// The least traffic of each size, and who has it.
type Least<'a> = [Option<(f64, &'a str)>; SIZES.len()];

fn derive(asked: &Asked<'_>) -> Result<Derived, ReportError> {
    let mut found: Vec<((&str, &str), Least<'_>)> = vec![];
    for row in asked.table(0)?.rows() {
        if row.text("series")? == HOLDS_THE_MAP {
            continue;
        }
        let key = (row.text("photons")?, row.text("record")?);
        if !found.iter().any(|(other, _)| *other == key) {
            found.push((key, [None; SIZES.len()]));
        }
        let (_, least) = found.iter_mut().find(|(other, _)| *other == key).expect("just put there");
        let (on_chip, total, point) = (row.number("on_chip_bytes")?, row.number("total_bytes")?, row.text("point")?);
        for ((_, bytes), least) in SIZES.iter().zip(least) {
            if on_chip <= *bytes && least.is_none_or(|(other, _)| total < other) {
                *least = Some((total, point));
            }
        }
    }
    // Small maps first.
    let photons = |key: (&str, &str)| number(key.0).unwrap_or(0.0);
    found.sort_by(|(a, _), (b, _)| photons(*a).total_cmp(&photons(*b)));
    let mut text = "Least traffic by all bytes on chip:\n".to_owned();
    let _ = writeln!(text, "{:>8}  {:<8} {:>8} {:>9}  order", "photons", "records", "on chip", "GB");
    for ((photons, record), least) in found {
        for ((size, _), least) in SIZES.iter().zip(least) {
            if let Some((total, order)) = least {
                let _ = writeln!(text, "{photons:>8}  {record:<8} {size:>8} {:>9.3}  {order}", total / 1e9);
            }
        }
    }
    Ok(text.into())
}
