//! Drawing a plot as SVG.

use super::{Axis, Plot, Point, Series};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::prelude::*;
use std::ops::Range;

/// How a plot looks.
#[derive(Clone, Debug)]
pub struct Look {
    /// What stands above it; may be empty.
    pub title: String,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Are points joined by lines?
    pub lines: bool,
    /// Is the frontier drawn, as steps?
    pub frontier: bool,
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Ruler, Ruler>>;

/// An axis for the library: places, and ticks at some of them.
struct Ruler {
    low: f64,
    high: f64,
    ticks: Vec<f64>,
}

impl Ruler {
    fn new(axis: &Axis, (low, high): (f64, f64)) -> Self {
        Self { low, high, ticks: axis.ticks(low, high) }
    }
}

impl Ranged for Ruler {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, (from, to): (i32, i32)) -> i32 {
        from + ((place - self.low) / (self.high - self.low) * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

/// Colours that people with any kind of colour vision tell apart: Okabe and Ito, *Color Universal Design*, 2008, without
/// the yellow, which is faint on white.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x8a, 0x5a, 0x3c),
];
const PAPER: RGBColor = RGBColor(0xff, 0xff, 0xff);
const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
const GRID: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
const GREY: RGBColor = RGBColor(0x80, 0x80, 0x80);

/// On a dark page: what the ink, the paper and the grid become.
const DARK: &str = "<style>@media (prefers-color-scheme: dark){\
    [fill=\"#FFFFFF\"]{fill:#16181c}[fill=\"#222222\"]{fill:#e4e4e4}[stroke=\"#222222\"]{stroke:#b8b8b8}\
    [stroke=\"#DDDDDD\"]{stroke:#3a3d42}[fill=\"#0072B2\"]{fill:#4aa8e0}[stroke=\"#0072B2\"]{stroke:#4aa8e0}\
    [fill=\"#8A5A3C\"]{fill:#c08a66}[stroke=\"#8A5A3C\"]{stroke:#c08a66}}</style>";

/// Height of a line of text in pixels.
const LETTER: i32 = 13;
/// Half the extent of a mark in pixels.
const MARK: i32 = 4;

impl Plot {
    /// Draws the plot. Equal plots give equal bytes.
    ///
    /// # Panics
    /// Never: the library draws into memory, and no plot is without a point.
    #[must_use]
    pub fn svg(&self, look: &Look) -> String {
        let mut svg = String::new();
        {
            let root = SVGBackend::with_string(&mut svg, look.size).into_drawing_area();
            self.draw(&root, look).expect("drawing into memory does not fail");
        }
        // Behind the opening tag: a style for dark pages, and the title for those who hear it.
        let title = format!("<title>{}</title>", escaped(&look.title));
        let inside = svg.find("<svg").and_then(|at| Some(at + svg[at..].find('>')? + 1)).unwrap_or(0);
        svg.insert_str(inside, &format!("{title}{DARK}"));
        svg
    }

    fn draw(&self, root: &Area<'_>, look: &Look) -> Result<(), Box<dyn std::error::Error + '_>> {
        root.fill(&PAPER)?;
        let points = || self.series.iter().chain(&self.reference).flat_map(|series| &series.points);
        let (x, y) = (&self.x, &self.y);
        let xs = x.range(points().map(|point| point.x));
        // Intervals lie within the picture, unless they reach to where a logarithm has no place.
        let bars = |point: &Point| {
            let (low, high) = interval(point);
            [low, point.y, high].into_iter().filter(move |&value| y.place(value).is_finite())
        };
        let ys = y.range(points().flat_map(bars));

        let names: Vec<&str> = self.series.iter().chain(&self.reference).map(|series| series.name.as_str()).collect();
        let width = i32::try_from(look.size.0)?;
        // The library measures text only with the fonts of a system; six pixels a letter is about right.
        let longest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        let legend = i32::try_from(longest)?.saturating_mul(6).saturating_add(44).min(width / 2);
        let (left, right) = root.split_horizontally(width - legend);

        let mut builder = ChartBuilder::on(&left);
        builder.margin(8).margin_right(18).x_label_area_size(44).y_label_area_size(64);
        if !look.title.is_empty() {
            builder.caption(&look.title, ("sans-serif", LETTER + 3).into_font().color(&INK));
        }
        let mut chart = builder.build_cartesian_2d(Ruler::new(x, xs), Ruler::new(y, ys))?;
        chart
            .configure_mesh()
            .bold_line_style(GRID)
            .light_line_style(TRANSPARENT)
            .axis_style(INK)
            .label_style(("sans-serif", LETTER).into_font().color(&INK))
            .axis_desc_style(("sans-serif", LETTER + 1).into_font().color(&INK))
            .x_desc(&x.label)
            .y_desc(&y.label)
            .x_label_formatter(&|&place| x.tick_label(place))
            .y_label_formatter(&|&place| y.tick_label(place))
            .draw()?;

        for (number, series) in self.reference.iter().enumerate() {
            self.draw_series(&mut chart, series, GREY, number, false)?;
        }
        if look.frontier {
            self.draw_frontier(&mut chart)?;
        }
        for (number, series) in self.series.iter().enumerate() {
            self.draw_series(&mut chart, series, COLOURS[number % COLOURS.len()], number, look.lines)?;
        }

        for (row, name) in names.iter().enumerate() {
            let height = 36 + i32::try_from(row)? * (LETTER + 7);
            let (number, colour) = match row.checked_sub(self.series.len()) {
                Some(reference) => (reference, GREY),
                None => (row, COLOURS[row % COLOURS.len()]),
            };
            if look.lines && row < self.series.len() {
                right.draw(&PathElement::new(vec![(2, height), (26, height)], colour.stroke_width(2)))?;
            }
            mark(&right, (14, height), number, colour)?;
            let style = ("sans-serif", LETTER).into_font().color(&INK);
            right.draw(&Text::new((*name).to_owned(), (32, height - LETTER / 2), style))?;
        }
        root.present()?;
        Ok(())
    }

    fn draw_series(
        &self,
        chart: &mut Chart<'_, '_>,
        series: &Series,
        colour: RGBColor,
        number: usize,
        lines: bool,
    ) -> Result<(), Box<dyn std::error::Error + '_>> {
        let place = |point: &Point| (self.x.place(point.x), self.y.place(point.y));
        if lines {
            chart.draw_series(LineSeries::new(series.points.iter().map(place), colour.stroke_width(2))).map_err(own)?;
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
    fn draw_frontier(&self, chart: &mut Chart<'_, '_>) -> Result<(), Box<dyn std::error::Error + '_>> {
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

/// More points than this in a line are not marked.
const MOST_MARKED: usize = 60;

/// The ends of a point's interval.
fn interval(point: &Point) -> (f64, f64) {
    let half = point.error.unwrap_or(0.0);
    (point.y - half, point.y + half)
}

/// Draws the mark of series number `number`: another shape for each, so that no one depends on colours alone.
fn mark(
    area: &Area<'_>,
    (x, y): (i32, i32),
    number: usize,
    colour: RGBColor,
) -> Result<(), Box<dyn std::error::Error>> {
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

/// An error of the library's as one that lives by itself.
fn own(error: impl std::fmt::Display) -> Box<dyn std::error::Error> {
    error.to_string().into()
}

/// Text as XML has it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::super::{Scale, Selection};
    use super::*;

    fn plot(table: &str) -> Plot {
        let selection = Selection {
            x: "size".into(),
            y: "fetches".into(),
            by: vec!["order".into()],
            error: Some("width".into()),
            y_scale: Scale::Log10,
            ..Selection::default()
        };
        Plot::read(&selection, vec![("t".to_owned(), table.as_bytes())], vec![]).expect("a plot")
    }

    fn look() -> Look {
        Look { title: "a < b".into(), size: (800, 500), lines: true, frontier: true }
    }

    /// Centres of the circles of the first series, in the order drawn, the legend's left out.
    fn circles(svg: &str) -> Vec<(f64, f64)> {
        let attribute = |tag: &str, name: &str| -> f64 {
            let from = tag.find(&format!(" {name}=\"")).expect("the attribute") + name.len() + 3;
            tag[from..].split('"').next().expect("a value").parse().expect("a number")
        };
        let tags = svg.split('<').filter(|tag| tag.starts_with("circle"));
        let all: Vec<_> = tags.map(|tag| (attribute(tag, "cx"), attribute(tag, "cy"))).collect();
        all[..all.len() - 1].to_vec()
    }

    #[test]
    fn equal_ratios_are_equal_lengths() {
        let svg = plot("order,size,fetches,width\na,1024,1000,\na,4096,100,\na,1048576,10,\n").svg(&look());
        let at = circles(&svg);
        assert_eq!(at.len(), 3);
        // Two doublings, then eight; a decade each down.
        let ((dx1, dy1), (dx2, dy2)) = ((at[1].0 - at[0].0, at[1].1 - at[0].1), (at[2].0 - at[1].0, at[2].1 - at[1].1));
        assert!((dx2 / dx1 - 4.0).abs() < 0.05, "{at:?}");
        assert!(dy1 > 50.0 && (dy2 - dy1).abs() <= 1.0, "{at:?}");
    }

    #[test]
    fn the_picture_is_whole_and_the_same_each_time() {
        let table = "order,size,fetches,width\na,1024,1000,20\na,1048576,10,300\nb,2048,5,\n";
        let svg = plot(table).svg(&look());
        assert_eq!(svg, plot(table).svg(&look()));
        assert!(svg.contains("a &lt; b") && !svg.contains("a < b"));
        for text in ["fetches", "size", "1K", "prefers-color-scheme"] {
            assert!(svg.contains(text), "{text}");
        }
        let count = |tag: &str| svg.matches(tag).count();
        assert_eq!(count("<svg"), count("</svg>"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }

    #[test]
    fn every_colour_of_the_style_is_one_that_is_drawn() {
        let svg = plot("order,size,fetches,width\na,1,1,\nb,2,5,\n").svg(&look());
        for colour in [PAPER, INK, GRID, COLOURS[0]] {
            let name = format!("#{:02X}{:02X}{:02X}", colour.0, colour.1, colour.2);
            assert!(DARK.contains(&name) && svg.replace(DARK, "").contains(&name), "{name}");
        }
    }
}
