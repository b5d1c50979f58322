//! The legend beside a plot.

use super::{Area, Drawn, LETTER, draw_key, own};
use crate::chart::Plot;
use crate::chart::colours::{GREY, INK, of_series};
use plotters::prelude::*;

impl Plot {
    /// Draws a key and a name for each series, however many there are, below one another in this height.
    pub(super) fn draw_legend(&self, area: &Area<'_>, height: i32, lines: bool) -> Drawn {
        let names: Vec<&str> = self.names().collect();
        let rows = i32::try_from(names.len().max(1))?;
        let step = ((height - 48) / rows).clamp(1, LETTER + 4);
        for (row, name) in names.iter().enumerate() {
            let at = 36 + i32::try_from(row)? * step;
            let (number, colour, lines) = match row.checked_sub(self.series.len()) {
                Some(reference) => (reference, GREY, false),
                None => (row, of_series(row), lines),
            };
            draw_key(area, at, number, colour, lines)?;
            let style = ("sans-serif", LETTER.min(step)).into_font().color(&INK);
            area.draw(&Text::new((*name).to_owned(), (32, at - LETTER.min(step) / 2), style)).map_err(own)?;
        }
        Ok(())
    }
}
