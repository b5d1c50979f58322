//! Which part of some tables is drawn.

use super::Scale;

/// Which columns are drawn, and of which rows.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// The column across. Its values may be words.
    pub x: String,
    /// The column up.
    pub y: String,
    /// The columns whose values together name a series; none: the tables' names do.
    pub by: Vec<String>,
    /// The column of half widths of intervals around y.
    pub error: Option<String>,
    /// Only rows that have these values in these columns; of several values of a column, any.
    pub only: Vec<(String, String)>,
    /// Scale of x.
    pub x_scale: Scale,
    /// Scale of y.
    pub y_scale: Scale,
}
