//! Charts: a table in, an SVG picture out.
//!
//! A [`Plot`] is series of points over two axes. [`read`](Plot::read) makes one from tables and a [`Selection`] of
//! their columns, [`svg`](Plot::svg) draws it. What a scale is and where its ticks are is [`Scale`]'s; the drawing of
//! lines and letters is a library's.

mod axis;
mod colours;
mod draw;
mod frontier;
mod look;
mod parts;
mod read;
mod selection;
mod svg;

pub use axis::{Axis, Scale};
pub use colours::dark_style;
pub use frontier::unbeaten;
pub use look::Look;
pub use parts::MOST_SERIES;
pub(crate) use parts::part_title;
pub use selection::Selection;

use std::sync::Arc;

/// A point of a series, in the units of the axes; on an axis of words, the number of the word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Across.
    pub x: f64,
    /// Up.
    pub y: f64,
    /// Half the width of the interval that holds the true y, if known.
    pub error: Option<f64>,
}

/// Points that belong together, from left to right; on an axis of words, in the order of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Its points, never empty.
    pub points: Vec<Point>,
}

impl Plot {
    /// The number by which a series to compare with is marked: that of ours that it belongs to, if there is one.
    pub(crate) fn mark_of(&self, reference: usize) -> usize {
        self.owner(reference).unwrap_or(reference)
    }

    /// The number of the series of ours that one to compare with belongs to.
    pub(crate) fn owner(&self, reference: usize) -> Option<usize> {
        let name = &self.reference[reference].name;
        let is_its = |ours: &Series| {
            *name == ours.name || name.strip_prefix(&ours.name).is_some_and(|rest| rest.starts_with(" ("))
        };
        self.series.iter().position(is_its)
    }
}

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// The axis across.
    pub x: Axis,
    /// The axis up.
    pub y: Axis,
    /// The series, in the order in which they first appear in the tables.
    pub series: Vec<Series>,
    /// Points to compare with, drawn in grey.
    pub reference: Vec<Series>,
    /// The plot that this is a part of, whose axes and frontier it has.
    pub(crate) whole: Option<Arc<Plot>>,
}
