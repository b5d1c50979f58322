//! What was measured of parts of an experiment: mean radiance of rectangles, or rows by name.

use pm_report::ReportError;
use pm_report::sheet::{Sheet, number};

/// The channels, as columns name them.
pub(crate) const CHANNELS: [&str; 3] = ["r", "g", "b"];

/// A part of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measured {
    /// Its name, or its rectangle: `x0 y0 x1 y1`.
    pub(crate) part: String,
    /// How many pixels it has; of what has none, 1.
    pub(crate) pixels: f64,
    /// The value in each channel. What is no number was not measured: it is neither near nor far.
    pub(crate) value: [Option<f64>; 3],
    /// The standard errors; 0 where there is none.
    pub(crate) error: [f64; 3],
}

/// The rows of a table, which is what `pm-view --mean --format csv` prints, or has rows of name,r,g,b and maybe se_r,se_g,se_b.
///
/// # Errors
/// If a column is missing.
pub(crate) fn read(sheet: &Sheet) -> Result<Vec<Measured>, ReportError> {
    // What printed nothing has measured nothing.
    if sheet.columns().is_empty() {
        return Ok(vec![]);
    }
    let part: Vec<usize> = match sheet.find("name") {
        Some(name) => vec![name],
        None => ["x0", "y0", "x1", "y1"].iter().map(|corner| sheet.column(corner)).collect::<Result<_, _>>()?,
    };
    let channels = CHANNELS.iter().map(|channel| sheet.column(channel)).collect::<Result<Vec<_>, _>>()?;
    let errors = CHANNELS.map(|channel| sheet.find(&format!("se_{channel}")));
    let pixels = sheet.find("pixels");
    let measured = sheet.rows().iter().map(|row| {
        let at = |column: Option<usize>| column.and_then(|column| number(&row[column]));
        Measured {
            part: part.iter().map(|&column| &row[column]).collect::<Vec<_>>().join(" "),
            pixels: at(pixels).unwrap_or(1.0),
            value: std::array::from_fn(|channel| at(Some(channels[channel]))),
            error: errors.map(|column| at(column).unwrap_or(0.0)),
        }
    });
    Ok(measured.collect())
}
