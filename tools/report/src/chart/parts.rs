//! Plots with more series than can be told apart: several drawings over the same axes.

use super::{Look, Plot, Series};
use std::sync::Arc;

/// Series that a drawing has at most: as many as there are colours, and as have room for their names where they end.
pub const MOST_SERIES: usize = 7;

impl Plot {
    /// This plot, or, if it has more than [`MOST_SERIES`], parts of it with about as many series each, in their order. Parts
    /// have the axes and the frontier of the whole; what is compared with a series is in its part, and all else that is
    /// compared with in the first.
    #[must_use]
    pub(crate) fn parts(self) -> Vec<Self> {
        let count = self.series.len().div_ceil(MOST_SERIES);
        if count <= 1 {
            return vec![self];
        }
        let whole = Arc::new(self);
        let each = whole.series.len().div_ceil(count);
        let part_of = |reference: usize| whole.owner(reference).map_or(0, |series| series / each);
        let part = |(number, series): (usize, &[Series])| Self {
            x: whole.x.clone(),
            y: whole.y.clone(),
            series: series.to_vec(),
            reference: (0..whole.reference.len())
                .filter(|&reference| part_of(reference) == number)
                .map(|reference| whole.reference[reference].clone())
                .collect(),
            whole: Some(Arc::clone(&whole)),
        };
        whole.series.chunks(each).enumerate().map(part).collect()
    }

    /// Draws the plot as a picture of its own, of the size that is asked for; if it has more than [`MOST_SERIES`], its parts one
    /// below another, each of that size.
    #[must_use]
    pub fn picture(self, look: &Look) -> String {
        let parts = self.parts();
        if let [only] = &parts[..] {
            return only.svg(look);
        }
        let ((width, height), count) = (look.size, parts.len());
        let drawings: String = parts
            .iter()
            .enumerate()
            .map(|(number, part)| {
                let title = part_title(&look.title, number, count);
                let svg = part.svg(&Look { title, ..look.clone() });
                svg.replacen("<svg", &format!("<svg y=\"{}\"", u64::from(height) * number as u64), 1)
            })
            .collect();
        let height = u64::from(height) * count as u64;
        format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" xmlns=\"http://www.w3.org/2000/svg\">\n\
             {drawings}</svg>\n"
        )
    }
}

/// What stands above a part; above the only one, and without a title, nothing more than there is.
pub(crate) fn part_title(title: &str, number: usize, count: usize) -> String {
    if title.is_empty() || count == 1 { title.to_owned() } else { format!("{title} ({} of {count})", number + 1) }
}

#[cfg(test)]
mod tests;
