//! Pictures as text: one described, or two compared.

use crate::image::{Comparison, Description};
use crate::report::{Column, Table, Value};
use std::io::{self, Write};

/// Writes what there is to say of a picture.
///
/// # Errors
/// What `output` reports.
pub fn picture(description: &Description, output: &mut impl Write) -> io::Result<()> {
    let Description { size: [width, height], channels, attributes } = description;
    writeln!(output, "{:<12} {width} x {height} pixels", "picture")?;
    for channel in channels {
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

/// The table of a comparison, one row; `a` is the reference.
#[must_use]
pub fn comparison(a: &str, b: &str, comparison: &Comparison) -> Table {
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
    ];
    let (columns, row) = cells.into_iter().unzip();
    let mut table = Table::new(columns);
    table.push(row);
    table
}
