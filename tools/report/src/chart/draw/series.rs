//! Series of a plot: lines, intervals and marks; and the frontier of all of them.

use super::marks::{is_dashed, mark};
use super::{Chart, Drawn, interval, own};
use crate::chart::colours::INK;
use crate::chart::{Plot, Point, Series};
use plotters::prelude::*;

/// Length of a dash and of the gap behind it in pixels.
const DASH: (i32, i32) = (6, 4);

/// More points than this in a line are not marked.
const MOST_MARKED: usize = 60;

impl Plot {
    /// Draws a series, which is number `number` of its kind.
    pub(super) fn draw_series(
        &self,
        chart: &mut Chart<'_, '_>,
        series: &Series,
        colour: RGBColor,
        number: usize,
        lines: bool,
    ) -> Drawn {
        let place = |point: &Point| (self.x.place(point.x), self.y.place(point.y));
        if lines {
            let points: Vec<_> = series.points.iter().map(place).collect();
            if is_dashed(number) {
                let dashes = DashedLineSeries::new(points, DASH.0, DASH.1, colour.stroke_width(2));
                chart.draw_series(dashes).map_err(own)?;
            } else {
                chart.draw_series(LineSeries::new(points, colour.stroke_width(2))).map_err(own)?;
            }
        }
        let area = chart.plotting_area();
        let bottom = area.get_pixel_range().1.end;
        let inner = area.strip_coord_spec();
        let corner = area.get_base_pixel();
        for point in &series.points {
            let at = area.map_coordinate(&place(point));
            let at = (at.0 - corner.0, at.1 - corner.1);
            if point.error.is_some() {
                let (low, high) = interval(point);
                let row = |value: f64| {
                    let place = self.y.place(value);
                    let row = if place.is_finite() { area.map_coordinate(&(0.0, place)).1 } else { bottom };
                    row.min(bottom) - corner.1
                };
                for (from, to) in [
                    ((at.0, row(low)), (at.0, row(high))),
                    ((at.0 - 3, row(low)), (at.0 + 3, row(low))),
                    ((at.0 - 3, row(high)), (at.0 + 3, row(high))),
                ] {
                    inner.draw(&PathElement::new(vec![from, to], colour.stroke_width(1))).map_err(own)?;
                }
            }
            // A long curve would be nothing but marks.
            if !lines || series.points.len() <= MOST_MARKED {
                mark(&inner, at, number, colour).map_err(own)?;
            }
        }
        Ok(())
    }

    /// The frontier as steps: from each point on, its height is what can be had.
    pub(super) fn draw_frontier(&self, chart: &mut Chart<'_, '_>) -> Drawn {
        let mut steps: Vec<(f64, f64)> = vec![];
        for point in self.frontier().points {
            let at = (self.x.place(point.x), self.y.place(point.y));
            if let Some(&(_, before)) = steps.last() {
                steps.push((at.0, before));
            }
            steps.push(at);
        }
        chart.draw_series(LineSeries::new(steps, INK.stroke_width(1))).map_err(own)?;
        Ok(())
    }
}
