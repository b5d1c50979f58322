//! Drawing a plot as SVG.

use super::colours::{GREY, GRID, INK, PAPER, SERIES, dark_style, of_series};
use super::{Axis, Plot, Point, Series};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;
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
    /// Is there a legend beside it?
    pub legend: bool,
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// What came of drawing.
type Drawn = Result<(), Box<dyn Error>>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Ruler, Ruler>>;

/// An axis for the library: places, and ticks at some of them.
struct Ruler {
    low: f64,
    high: f64,
    ticks: Vec<f64>,
}

impl Ruler {
    fn new(axis: &Axis, (low, high): (f64, f64), most_ticks: u32) -> Self {
        Self { low, high, ticks: axis.ticks(low, high, most_ticks) }
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

/// Width and height of a key of the legend in pixels.
const KEY: (u32, u32) = (28, 14);
/// Height of a line of text in pixels; the library's letters are 1.24 times smaller.
const LETTER: i32 = 16;
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
        let title = format!("<title>{}</title><style>{}</style>", escaped(&look.title), dark_style());
        svg.insert_str(behind_tag(&svg), &title);
        svg
    }

    /// Draws the plot as a part of an HTML page, which brings the [`dark_style`] and may stretch it. The title is not
    /// drawn but told; the legend is left to the page, see [`keys`](Self::keys).
    #[must_use]
    pub fn svg_in_page(&self, look: &Look, class: &str) -> String {
        let bare = Look { title: String::new(), legend: false, ..look.clone() };
        let svg = self.svg(&bare);
        let drawn = svg.find("</style>").map_or(&*svg, |at| svg[at + "</style>".len()..].trim_start());
        let (width, height) = look.size;
        format!(
            "<svg class=\"{class}\" role=\"img\" viewBox=\"0 0 {width} {height}\"><title>{}</title>{drawn}",
            escaped(&look.title)
        )
    }

    /// A legend for a page: the name of each series, of each of the reference and of the frontier, if it is drawn, with its
    /// key as SVG.
    ///
    /// # Panics
    /// Never: the library draws into memory.
    #[must_use]
    pub fn keys(&self, look: &Look) -> Vec<(&str, String)> {
        let (width, height) = KEY;
        let middle = height as i32 / 2;
        let key = |draw: &dyn Fn(&Area<'_>) -> Drawn| {
            let mut svg = String::new();
            draw(&SVGBackend::with_string(&mut svg, KEY).into_drawing_area())
                .expect("drawing into memory does not fail");
            let drawn = &svg[behind_tag(&svg)..];
            format!("<svg class=\"key\" aria-hidden=\"true\" width=\"{width}\" height=\"{height}\">{drawn}")
        };
        let ours = self.series.iter().enumerate().map(|(number, series)| {
            (&*series.name, key(&|area| draw_key(area, middle, number, of_series(number), look.lines)))
        });
        let reference = self.reference.iter().enumerate();
        let reference =
            reference.map(|(number, series)| (&*series.name, key(&|area| draw_key(area, middle, number, GREY, false))));
        let step = PathElement::new(vec![(2, middle), (26, middle)], INK.stroke_width(1));
        let frontier = look.frontier.then(|| ("frontier", key(&|area| area.draw(&step).map_err(own))));
        ours.chain(reference).chain(frontier).collect()
    }

    fn draw(&self, root: &Area<'_>, look: &Look) -> Result<(), Box<dyn Error + '_>> {
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
        let (width, height) = (i32::try_from(look.size.0)?, i32::try_from(look.size.1)?);
        let longest = names.iter().map(|name| letters(name)).max().unwrap_or(0);
        let legend = if look.legend { longest.saturating_add(44).min(width / 2) } else { 0 };
        let (left, right) = root.split_horizontally(width - legend);

        // Words that do not fit beside one another stand upright.
        let longest = x.words().iter().map(|word| letters(word)).max().unwrap_or(0);
        let room = (width - legend - 68 - 26) / i32::try_from(x.words().len().max(1))?;
        let upright = longest > room;
        let labels = if upright { longest.saturating_add(40).min(height / 2) } else { 46 };

        let mut builder = ChartBuilder::on(&left);
        builder.margin(8).margin_right(18).x_label_area_size(labels).y_label_area_size(68);
        if !look.title.is_empty() {
            builder.caption(&look.title, ("sans-serif", LETTER + 3).into_font().color(&INK));
        }
        // A tick for each 60 pixels across and each 40 up, but no more than ten or so.
        let most = |pixels: i32, each: i32| u32::try_from(pixels / each).unwrap_or(0).min(10);
        let across = Ruler::new(x, xs, most(width - legend, 60));
        let mut chart = builder.build_cartesian_2d(across, Ruler::new(y, ys, most(height, 40)))?;
        let letter = ("sans-serif", LETTER).into_font();
        chart
            .configure_mesh()
            .bold_line_style(GRID)
            .light_line_style(TRANSPARENT)
            .axis_style(INK)
            .label_style(letter.color(&INK))
            .axis_desc_style(("sans-serif", LETTER + 1).into_font().color(&INK))
            .x_desc(&x.label)
            .y_desc(&y.label)
            .x_label_formatter(&|&place| if upright { String::new() } else { x.tick_label(place) })
            .y_label_formatter(&|&place| y.tick_label(place))
            .draw()?;
        if upright {
            // The library would centre them on the axis.
            let style = letter.transform(FontTransform::Rotate270).color(&INK).pos(Pos::new(HPos::Right, VPos::Center));
            let area = chart.plotting_area();
            let bottom = area.get_pixel_range().1.end + 8;
            for (at, word) in x.words().iter().enumerate() {
                let across = area.map_coordinate(&(at as f64, 0.0)).0;
                root.draw(&Text::new(word.clone(), (across, bottom), style.clone()))?;
            }
        }

        for (number, series) in self.reference.iter().enumerate() {
            self.draw_series(&mut chart, series, GREY, number, false)?;
        }
        if look.frontier {
            self.draw_frontier(&mut chart)?;
        }
        for (number, series) in self.series.iter().enumerate() {
            self.draw_series(&mut chart, series, of_series(number), number, look.lines)?;
        }

        // However many series there are, all are named.
        let rows = i32::try_from(names.len().max(1))?;
        let step = ((height - 48) / rows).clamp(1, LETTER + 4);
        for (row, name) in names.iter().enumerate().filter(|_| look.legend) {
            let at = 36 + i32::try_from(row)? * step;
            let (number, colour, lines) = match row.checked_sub(self.series.len()) {
                Some(reference) => (reference, GREY, false),
                None => (row, of_series(row), look.lines),
            };
            draw_key(&right, at, number, colour, lines)?;
            let style = ("sans-serif", LETTER.min(step)).into_font().color(&INK);
            right.draw(&Text::new((*name).to_owned(), (32, at - LETTER.min(step) / 2), style))?;
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
    ) -> Result<(), Box<dyn Error + '_>> {
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
    fn draw_frontier(&self, chart: &mut Chart<'_, '_>) -> Result<(), Box<dyn Error + '_>> {
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

/// Draws the key of series number `number` at this height of the legend.
fn draw_key(area: &Area<'_>, at: i32, number: usize, colour: RGBColor, lines: bool) -> Drawn {
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
const fn is_dashed(number: usize) -> bool {
    number / SERIES.len() % 2 == 1
}

/// Length of a dash and of the gap behind it in pixels.
const DASH: (i32, i32) = (6, 4);

/// About how many pixels wide a text is. The library would measure it only with the fonts of a system.
fn letters(text: &str) -> i32 {
    i32::try_from(text.chars().count()).unwrap_or(i32::MAX).saturating_mul(7)
}

/// Behind the opening tag of a picture.
fn behind_tag(svg: &str) -> usize {
    svg.find("<svg").and_then(|at| Some(at + svg[at..].find('>')? + 1)).unwrap_or(0)
}

/// More points than this in a line are not marked.
const MOST_MARKED: usize = 60;

/// The ends of a point's interval.
fn interval(point: &Point) -> (f64, f64) {
    let half = point.error.unwrap_or(0.0);
    (point.y - half, point.y + half)
}

/// Draws the mark of series number `number`: another shape for each, so that no one depends on colours alone.
fn mark(area: &Area<'_>, (x, y): (i32, i32), number: usize, colour: RGBColor) -> Drawn {
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
fn own(error: impl std::fmt::Display) -> Box<dyn Error> {
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
        Look { title: "a < b".into(), size: (800, 500), lines: true, frontier: true, legend: true }
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
    fn a_part_of_a_page_has_no_style_of_its_own_and_a_key_for_each_series() {
        let plot = plot("order,size,fetches,width\na,1,1,\nb,2,5,\n");
        let svg = plot.svg_in_page(&look(), "wide");
        assert!(svg.starts_with("<svg class=\"wide\" role=\"img\" viewBox=\"0 0 800 500\"><title>a &lt; b</title><"));
        assert!(!svg.contains("<style") && svg.matches("<svg").count() == 1 && svg.trim_end().ends_with("</svg>"));
        // The marks are the points', not a legend's.
        assert_eq!(svg.matches("<circle").count(), 1);
        let keys = plot.keys(&look());
        assert_eq!(keys.iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["a", "b", "frontier"]);
        assert!(keys[0].1.contains("<circle") && keys[1].1.contains("<rect"), "{keys:?}");
    }

    #[test]
    fn every_series_is_named_however_many_there_are() {
        let rows: String = (0..60).map(|i| format!("series{i},1,{},\n", i + 1)).collect();
        let svg = plot(&format!("order,size,fetches,width\n{rows}")).svg(&look());
        for i in 0..60 {
            assert!(svg.contains(&format!("\nseries{i}\n")), "series{i}");
        }
        let lowest = svg
            .split("<text ")
            .filter(|text| text.contains("\nseries59\n"))
            .find_map(|text| text.split(" y=\"").nth(1)?.split('"').next()?.parse::<i32>().ok());
        assert!(lowest.expect("the last series is named") < 500);
    }

    #[test]
    fn long_words_stand_upright() {
        let words = |word: &str| (0..9).map(|i| format!("a,{word}{i},1,\n")).collect::<String>();
        let svg = |word: &str| plot(&format!("order,size,fetches,width\n{}", words(word))).svg(&look());
        let turned = |svg: &str| svg.matches("rotate(270").count();
        // The label of the axis up always is.
        assert_eq!(turned(&svg("a rather long word ")), turned(&svg("w")) + 9);
    }
}
