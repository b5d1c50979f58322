//! A plot as SVG: a picture of its own, or a part of a page.

use super::colours::{GREY, INK, dark_style, of_series};
use super::draw::{Area, Drawn, Names, draw_key, own};
use super::{Look, MOST_SERIES, Plot};
use plotters::prelude::*;

/// Width and height of a key of the legend in pixels.
const KEY: (u32, u32) = (28, 14);

impl Plot {
    /// Draws the plot, all series in one drawing. Equal plots give equal bytes.
    ///
    /// # Panics
    /// Never: the library draws into memory, and no plot is without a point.
    #[must_use]
    pub(crate) fn svg(&self, look: &Look) -> String {
        self.drawn(look, Names::WithKeys)
    }

    fn drawn(&self, look: &Look, names: Names) -> String {
        let mut svg = String::new();
        {
            let root = SVGBackend::with_string(&mut svg, look.size).into_drawing_area();
            self.draw(&root, look, names).expect("drawing into memory does not fail");
        }
        // Behind the opening tag: a style for dark pages, and the title for those who hear it.
        let title = format!("<title>{}</title><style>{}</style>", escaped(&look.title), dark_style());
        svg.insert_str(behind_tag(&svg), &title);
        // XML knows no other control characters, however they are written.
        svg.replace(|c: char| c.is_control() && !matches!(c, '\n' | '\r' | '\t'), "\u{fffd}")
    }

    /// Draws the plot as a part of an HTML page, which brings the [`dark_style`] and may stretch it. The title is not
    /// drawn but told. Lines have their names at their ends, if a legend is wanted; the keys are left to the page, see
    /// [`keys`](Self::keys).
    #[must_use]
    pub(crate) fn svg_in_page(&self, look: &Look, class: &str) -> String {
        let bare = Look { title: String::new(), legend: self.has_named_ends(look), ..look.clone() };
        let svg = self.drawn(&bare, Names::AtEnds);
        let drawn = svg.find("</style>").map_or(&*svg, |at| svg[at + "</style>".len()..].trim_start());
        let (width, height) = look.size;
        format!(
            "<svg class=\"{class}\" role=\"img\" viewBox=\"0 0 {width} {height}\"><title>{}</title>{drawn}",
            escaped(&look.title)
        )
    }

    /// Whether a drawing in a page, which looks so, has the names of its series where they end.
    pub(crate) fn has_named_ends(&self, look: &Look) -> bool {
        look.legend && look.lines && self.series.len() <= MOST_SERIES
    }

    /// A legend for a page: the name of each series, of each of the reference and of the frontier, if it is drawn, with its
    /// key as SVG.
    ///
    /// # Panics
    /// Never: the library draws into memory.
    #[must_use]
    pub(crate) fn keys(&self, look: &Look) -> Vec<(&str, String)> {
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
        let reference = reference.map(|(number, series)| {
            let number = self.mark_of(number);
            (&*series.name, key(&|area| draw_key(area, middle, number, GREY, false)))
        });
        let step = PathElement::new(vec![(2, middle), (26, middle)], INK.stroke_width(1));
        let frontier = look.frontier.then(|| ("frontier", key(&|area| area.draw(&step).map_err(own))));
        ours.chain(reference).chain(frontier).collect()
    }
}

/// Behind the opening tag of a picture.
fn behind_tag(svg: &str) -> usize {
    svg.find("<svg").and_then(|at| Some(at + svg[at..].find('>')? + 1)).unwrap_or(0)
}

/// Text as XML has it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests;
