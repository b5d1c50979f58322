//! Marks and lines of series: another shape for each, so that no one depends on colours alone.

use super::{Area, Drawn, own};
use crate::chart::colours::SERIES;
use plotters::prelude::*;

/// Half the extent of a mark in pixels.
const MARK: i32 = 4;

/// Draws the key of series number `number` at this height of the legend.
pub(in crate::chart) fn draw_key(area: &Area<'_>, at: i32, number: usize, colour: RGBColor, lines: bool) -> Drawn {
    if lines {
        let style = colour.stroke_width(2);
        let pieces: &[(i32, i32)] = if is_dashed(number) { &[(2, 8), (20, 26)] } else { &[(2, 26)] };
        for &(from, to) in pieces {
            area.draw(&PathElement::new(vec![(from, at), (to, at)], style)).map_err(own)?;
        }
    }
    mark(area, (14, at), number, colour)
}

/// The lines of series with a colour that an earlier one has are dashed.
pub(super) const fn is_dashed(number: usize) -> bool {
    number / SERIES.len() % 2 == 1
}

/// Draws the mark of series number `number`.
pub(super) fn mark(area: &Area<'_>, (x, y): (i32, i32), number: usize, colour: RGBColor) -> Drawn {
    let fill = colour.filled();
    let polygon = |corners: &[(i32, i32)]| corners.iter().map(|&(dx, dy)| (x + dx, y + dy)).collect::<Vec<_>>();
    match number % 6 {
        0 => area.draw(&Circle::new((x, y), MARK, fill)).map_err(own)?,
        1 => area
            .draw(&Rectangle::new([(x - MARK + 1, y - MARK + 1), (x + MARK - 1, y + MARK - 1)], fill))
            .map_err(own)?,
        2 => area.draw(&Polygon::new(polygon(&[(0, -5), (5, 4), (-5, 4)]), fill)).map_err(own)?,
        3 => area.draw(&Polygon::new(polygon(&[(0, -5), (5, 0), (0, 5), (-5, 0)]), fill)).map_err(own)?,
        4 => area.draw(&Circle::new((x, y), MARK, colour.stroke_width(2))).map_err(own)?,
        _ => area.draw(&Polygon::new(polygon(&[(0, 5), (5, -4), (-5, -4)]), fill)).map_err(own)?,
    }
    Ok(())
}
