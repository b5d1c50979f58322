//! Draws a plot: axes and their words, points, legend.

mod legend;
mod marks;
mod ruler;
mod series;

use super::colours::{GREY, GRID, INK, PAPER, of_series};
use super::{Axis, Look, MOST_SERIES, Plot, Point};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use ruler::Ruler;
use std::error::Error;

pub(super) use marks::draw_key;

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Ruler, Ruler>>;

/// What came of drawing.
pub(super) type Drawn = Result<(), Box<dyn Error>>;

/// What stands beside the names of series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Names {
    /// A key each, with line and mark; series to compare with have names too.
    WithKeys,
    /// A line each from where the series ends.
    AtEnds,
}

/// Height of a line of text in pixels; the library's letters are 1.24 times smaller.
const LETTER: i32 = 16;

impl Plot {
    /// Draws all of it. The names beside it have keys, or are joined to where their series end.
    pub(super) fn draw(&self, root: &Area<'_>, look: &Look, names: Names) -> Drawn {
        root.fill(&PAPER).map_err(own)?;
        let (width, height) = (i32::try_from(look.size.0)?, i32::try_from(look.size.1)?);
        let longest = self.names(names).map(letters).max().unwrap_or(0);
        let legend = if look.legend { longest.saturating_add(44).min(width / 2) } else { 0 };
        let (left, right) = root.split_horizontally(width - legend);

        let mut chart = self.axes(&left, look, (width - legend, height))?;
        for (number, series) in self.reference.iter().enumerate() {
            self.draw_series(&mut chart, series, GREY, self.mark_of(number), false)?;
        }
        if look.frontier {
            self.draw_frontier(&mut chart)?;
        }
        for (number, series) in self.series.iter().enumerate() {
            self.draw_series(&mut chart, series, of_series(number), number, look.lines)?;
        }
        if look.legend {
            let ends = if look.lines { self.ends(&chart) } else { vec![] };
            self.draw_legend(&right, height, look.lines, (names, ends))?;
        }
        root.present().map_err(own)
    }

    /// The names beside it, those of the reference last.
    fn names(&self, names: Names) -> impl Iterator<Item = &str> {
        let reference = if names == Names::WithKeys { &*self.reference } else { &[] };
        self.series.iter().chain(reference).map(|series| series.name.as_str())
    }

    /// Draws the axes with what stands beside them, in an area of this width and height.
    fn axes<'a, 'b>(
        &self,
        area: &'a Area<'b>,
        look: &Look,
        (width, height): (i32, i32),
    ) -> Result<Chart<'a, 'b>, Box<dyn Error>> {
        let (x, y) = (&self.x, &self.y);
        let (xs, ys) = self.extent();
        // Words that do not fit beside one another stand upright.
        let longest = x.words().iter().map(|word| letters(word)).max().unwrap_or(0);
        let room = (width - 68 - 26) / i32::try_from(x.words().len().max(1))?;
        let upright = longest > room;
        let labels = if upright { longest.saturating_add(40).min(height / 2) } else { 46 };

        let mut builder = ChartBuilder::on(area);
        builder.margin(8).margin_right(18).x_label_area_size(labels).y_label_area_size(68);
        if !look.title.is_empty() {
            builder.caption(&look.title, ("sans-serif", LETTER + 3).into_font().color(&INK));
        }
        // A tick for each 60 pixels across and each 40 up, but no more than ten or so.
        let most = |pixels: i32, each: i32| u32::try_from(pixels / each).unwrap_or(0).min(10);
        let across = Ruler::new(x, xs, most(width, 60));
        let mut chart = builder.build_cartesian_2d(across, Ruler::new(y, ys, most(height, 40))).map_err(own)?;
        chart
            .configure_mesh()
            .bold_line_style(GRID)
            .light_line_style(TRANSPARENT)
            .axis_style(INK)
            .label_style(("sans-serif", LETTER).into_font().color(&INK))
            .axis_desc_style(("sans-serif", LETTER + 1).into_font().color(&INK))
            .x_desc(&x.label)
            .y_desc(&y.label)
            .x_label_formatter(&|&place| if upright { String::new() } else { x.tick_label(place) })
            .y_label_formatter(&|&place| y.tick_label(place))
            .draw()
            .map_err(own)?;
        small_ticks(&chart, (x, xs), (y, ys))?;
        if upright {
            upright_words(area, &chart, x)?;
        }
        Ok(chart)
    }

    /// How far down each series ends, in pixels; of many there is no room for that.
    fn ends(&self, chart: &Chart<'_, '_>) -> Vec<i32> {
        if self.series.len() > MOST_SERIES {
            return vec![];
        }
        let area = chart.plotting_area();
        let down = |point: &Point| area.map_coordinate(&(self.x.place(point.x), self.y.place(point.y))).1;
        self.series.iter().map(|series| series.points.last().map_or(0, down)).collect()
    }

    /// The ends of both axes. Intervals lie within the picture, unless they reach to where a logarithm has no place.
    pub(super) fn extent(&self) -> ((f64, f64), (f64, f64)) {
        let whole = self.whole.as_deref().unwrap_or(self);
        let points = || whole.series.iter().chain(&whole.reference).flat_map(|series| &series.points);
        let y = &self.y;
        let bars = |point: &Point| {
            let (low, high) = interval(point);
            [low, point.y, high].into_iter().filter(move |&value| y.place(value).is_finite())
        };
        (self.x.range(points().map(|point| point.x)), y.range(points().flat_map(bars)))
    }
}

/// Small ticks on logarithmic axes, inwards.
fn small_ticks(chart: &Chart<'_, '_>, (x, xs): (&Axis, (f64, f64)), (y, ys): (&Axis, (f64, f64))) -> Drawn {
    let area = chart.plotting_area();
    let inner = area.strip_coord_spec();
    let corner = area.get_base_pixel();
    let (across, down) = area.get_pixel_range();
    let (bottom, left) = (down.end - corner.1, across.start - corner.0);
    for place in x.small_ticks(xs.0, xs.1) {
        let at = area.map_coordinate(&(place, ys.0)).0 - corner.0;
        inner.draw(&PathElement::new(vec![(at, bottom), (at, bottom - SMALL)], INK.stroke_width(1))).map_err(own)?;
    }
    for place in y.small_ticks(ys.0, ys.1) {
        let at = area.map_coordinate(&(xs.0, place)).1 - corner.1;
        inner.draw(&PathElement::new(vec![(left, at), (left + SMALL, at)], INK.stroke_width(1))).map_err(own)?;
    }
    Ok(())
}

/// Length of a small tick in pixels.
const SMALL: i32 = 4;

/// Words below the axis across. The library would centre them on the axis.
fn upright_words(root: &Area<'_>, chart: &Chart<'_, '_>, x: &Axis) -> Drawn {
    let letter = ("sans-serif", LETTER).into_font();
    let style = letter.transform(FontTransform::Rotate270).color(&INK).pos(Pos::new(HPos::Right, VPos::Center));
    let area = chart.plotting_area();
    let bottom = area.get_pixel_range().1.end + 8;
    for (at, word) in x.words().iter().enumerate() {
        let across = area.map_coordinate(&(at as f64, 0.0)).0;
        root.draw(&Text::new(word.clone(), (across, bottom), style.clone())).map_err(own)?;
    }
    Ok(())
}

/// The ends of a point's interval.
fn interval(point: &Point) -> (f64, f64) {
    let half = point.error.unwrap_or(0.0);
    (point.y - half, point.y + half)
}

/// About how many pixels wide a text is. The library would measure it only with the fonts of a system.
fn letters(text: &str) -> i32 {
    i32::try_from(text.chars().count()).unwrap_or(i32::MAX).saturating_mul(7)
}

/// An error of the library's as one that lives by itself.
pub(super) fn own(error: impl std::fmt::Display) -> Box<dyn Error> {
    error.to_string().into()
}
