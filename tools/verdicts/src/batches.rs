//! Means over independent repetitions.

use crate::derivation::fail;
use crate::{Asked, Derivation, Derived, VerdictError};
use pm_sweep::significant;
use std::fmt::Write as _;

/// Means of rows of the same name over files that hold independent repetitions, and their standard errors.
pub(crate) const BATCHES: Derivation = Derivation {
    word: "batches",
    help: "Means of rows of one name over files of independent repetitions, and their standard errors",
    settings: &[],
    derive,
};

/// A row's name: its own, or its rectangle.
pub(crate) fn part(row: crate::table::Row<'_>) -> String {
    match row.has("name") {
        true => row.text("name").to_owned(),
        false => ["x0", "y0", "x1", "y1"].map(|name| row.text(name)).join(" "),
    }
}

fn derive(asked: &Asked<'_>) -> Result<Derived, VerdictError> {
    let mut found: Vec<(String, Vec<[f64; 3]>)> = vec![];
    for row in asked.tables.iter().flat_map(|table| table.rows()) {
        let (name, value) = (part(row), ["r", "g", "b"].map(|channel| row.number(channel)));
        match found.iter_mut().find(|(other, _)| *other == name) {
            Some((_, values)) => values.push(value),
            None => found.push((name, vec![value])),
        }
    }
    let mut text = "name,r,g,b,se_r,se_g,se_b\n".to_owned();
    for (name, values) in found {
        let k = values.len() as f64;
        if values.len() < 2 {
            return fail(format!("{name} stands in one file only, which tells no error"));
        }
        text += &name;
        let sums = |f: fn(f64) -> f64| [0, 1, 2].map(|c| values.iter().map(|value| f(value[c])).sum::<f64>());
        let (sum, square) = (sums(|x| x), sums(|x| x * x));
        for sum in sum {
            let _ = write!(text, ",{}", significant(sum / k, 9));
        }
        for (sum, square) in sum.iter().zip(square) {
            let variance = (square - sum * sum / k) / (k - 1.0);
            let error = if variance > 0.0 { (variance / k).sqrt() } else { 0.0 };
            let _ = write!(text, ",{}", significant(error, 6));
        }
        text += "\n";
    }
    Ok(text.into())
}
