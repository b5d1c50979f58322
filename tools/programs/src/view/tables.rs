//! What is found of pictures, as text and tables.

use pm_pictures::{Comparison, Description, RegionMean};
use pm_report::{Column, Table, Value};
use std::io::{self, Write};

/// Writes what there is to say of a picture.
pub(super) fn picture(description: &Description, output: &mut impl Write) -> io::Result<()> {
    let Description { size: [width, height], channels, attributes } = description;
    writeln!(output, "{:<12} {width} x {height} pixels", "picture")?;
    for channel in channels {
        if channel.mean.is_nan() {
            let n = channel.not_finite;
            writeln!(output, "{:<12} {}: none of its {n} values is finite", "channel", channel.name)?;
            continue;
        }
        let odd = match channel.not_finite {
            0 => String::new(),
            n => format!(", {n} values not finite"),
        };
        let (min, mean, max) = (channel.min, channel.mean, channel.max);
        writeln!(output, "{:<12} {}: {min:.6} to {max:.6}, mean {mean:.6}{odd}", "channel", channel.name)?;
    }
    for (name, value) in attributes {
        for line in value.lines() {
            writeln!(output, "{name:<12} {line}")?;
        }
    }
    Ok(())
}

/// Mean FLIP of two pictures, and how it was looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flips {
    /// Of the previews.
    pub(super) ldr: f64,
    /// Stops by which they were brightened.
    pub(super) exposure: f32,
    /// Of the radiance.
    pub(super) hdr: f64,
    /// Pixels to a degree of the field of view.
    pub(super) pixels_per_degree: f64,
}

/// The table of a comparison, one row; `a` is the reference.
pub(super) fn comparison(a: &str, b: &str, comparison: &Comparison, flips: &Flips) -> Table {
    let real = |x: f64| Value::Float(x, 5);
    let [r, g, b_ratio] = comparison.ratio.map(|x| Value::Float(x, 6));
    let cells = [
        (Column::text("a"), Value::Text(a.to_owned())),
        (Column::text("b"), Value::Text(b.to_owned())),
        (Column::number("pixels"), Value::Int(comparison.pixels)),
        (Column::number("differing"), Value::Int(comparison.differing)),
        (Column::number("not_finite"), Value::Int(comparison.not_finite)),
        (Column::number("ratio_r"), r),
        (Column::number("ratio_g"), g),
        (Column::number("ratio_b"), b_ratio),
        (Column::number("rmse"), real(comparison.rmse)),
        (Column::number("rel_mse"), real(comparison.rel_mse)),
        (Column::number("mae"), real(comparison.mae)),
        (Column::number("max_difference"), real(comparison.largest)),
        (Column::number("ldr_flip"), real(flips.ldr)),
        (Column::number("exposure"), real(f64::from(flips.exposure))),
        (Column::number("hdr_flip"), real(flips.hdr)),
        (Column::number("pixels_per_degree"), Value::Float(flips.pixels_per_degree, 6)),
    ];
    let (columns, row) = cells.into_iter().unzip();
    let mut table = Table::new(columns);
    table.push(row);
    table
}

/// Writes a comparison for reading; `a` is the reference.
pub(super) fn in_short(
    a: &str,
    b: &str,
    comparison: &Comparison,
    flips: &Flips,
    output: &mut impl Write,
) -> io::Result<()> {
    let Comparison { pixels, not_finite, differing, ratio: [red, green, blue], rmse, rel_mse, mae, largest } =
        comparison;
    let Flips { ldr, exposure, hdr, .. } = flips;
    let odd = if *not_finite == 0 { String::new() } else { format!("; {not_finite} are not finite, and left out") };
    writeln!(output, "compared     {b} with {a}")?;
    writeln!(output, "pixels       {pixels}, of which {differing} differ{odd}")?;
    writeln!(output, "brightness   {red:.5} red, {green:.5} green, {blue:.5} blue: mean over that of {a}")?;
    writeln!(output, "relMSE       {rel_mse:.4e}")?;
    writeln!(output, "RMSE         {rmse:.4e}, mean absolute {mae:.4e}, largest {largest:.4e}")?;
    writeln!(
        output,
        "FLIP         {ldr:.4} of the previews at {exposure:+} stops, {hdr:.4} of the radiance (0 is the same)"
    )
}

/// A table of regions of pictures, a row for each picture's name and region.
pub(super) fn regions(found: &[(String, RegionMean)]) -> Table {
    let names = ["x0", "y0", "x1", "y1", "pixels", "not_finite", "r", "g", "b"];
    let numbers = names.into_iter().map(Column::number);
    let mut table = Table::new(std::iter::once(Column::text("picture")).chain(numbers).collect());
    for (picture, region) in found {
        let counts = region.rectangle.into_iter().map(u64::from).chain([region.pixels, region.not_finite]);
        let mut row = vec![Value::Text(picture.clone())];
        row.extend(counts.map(Value::Int));
        row.extend(region.mean.map(|mean| Value::Float(mean, 6)));
        table.push(row);
    }
    table
}
