//! Photons from rows.

use super::RowOptions;
use super::reader::Rows;
use super::spool::{Imported, Spool};
use pm_formats::vocabulary::measure;
use pm_formats::{Header, Number, Photon, StageReport, Step};
use pm_random::Random;
use std::io::BufRead;

/// Columns that mean something for photons; `photon`, a running number, is not needed.
const KNOWN: [&str; 13] =
    ["photon", "x", "y", "z", "power_r", "power_g", "power_b", "from_x", "from_y", "from_z", "n_x", "n_y", "n_z"];
/// Keeps the random numbers here apart from those of other purposes.
const ROUNDING: u64 = 0x696d_706f_7274;

/// Reads photons: `x,y,z`; `power_r,power_g,power_b`, flux in watts times the number of emitted paths (1); `from_x,
/// from_y,from_z`, towards where the photon came from (the normal); `n_x,n_y,n_z`, normal of the surface on that side
/// (the direction it came from, and without that 0,1,0).
///
/// Powers are rounded to RGBE up or down by a hash of the row, so that sums over many have no bias.
///
/// # Errors
/// With the line, if a number is missing, not finite or cannot be a power or a direction; usage errors for columns.
pub fn photons(input: impl BufRead, options: &RowOptions, step: Step) -> anyhow::Result<Imported<Photon>> {
    let mut rows = Rows::new(input, options)?;
    let columns = rows.columns.clone();
    let unused = columns.unknown(&KNOWN)?;
    let position = columns.position()?;
    let power = columns.triple(["power_r", "power_g", "power_b"])?;
    let from = columns.triple(["from_x", "from_y", "from_z"])?;
    let normal = columns.triple(["n_x", "n_y", "n_z"])?;

    let mut spool = Spool::new()?;
    while let Some(row) = rows.next()? {
        let at = row.triple(position)?;
        let power = power.map_or(Ok([1.0; 3]), |columns| row.triple(columns))?;
        let normal = normal.map(|columns| row.direction(columns)).transpose()?;
        let from = from.map(|columns| row.direction(columns)).transpose()?;
        let given = normal.or(from).unwrap_or([0.0, 1.0, 0.0]);
        let mut random = Random::new(&[ROUNDING, row.number]);
        let threshold = [(); 3].map(|()| random.unit());
        let photon = Photon::new(at, power, threshold, from.unwrap_or(given), given);
        let [r, g, b] = power;
        let refused = || row.wrong(format!("power {r}, {g}, {b}: numbers of 0 to 2^127 are needed"));
        spool.push(0, at, &photon.ok_or_else(refused)?)?;
    }
    let stage = StageReport::new(&step.program).with(measure::EMITTED_PATHS, Number::Count(options.emitted));
    let stage = stage.with("photons", Number::Count(spool.records));
    Ok(spool.finish(Header { history: vec![step], ..Header::empty() }, stage, unused))
}
