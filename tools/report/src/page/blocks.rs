//! The blocks of a section: what a description may say of charts, tables, pictures and texts.

use crate::chart::Scale;
use crate::sheet::Values;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A chart: what `pm-chart` can draw.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChartBlock {
    /// What stands above it.
    #[serde(default)]
    pub title: String,
    /// What is to be said of it, in Markdown.
    #[serde(default)]
    pub text: String,
    /// Behind its title, until that is clicked?
    #[serde(default)]
    pub folded: bool,
    /// By which links reach it.
    #[serde(default)]
    pub id: Option<String>,
    /// The command that makes its tables.
    #[serde(default)]
    pub command: Option<String>,
    /// Tables.
    pub tables: Vec<String>,
    /// Tables to compare with, in grey.
    #[serde(default)]
    pub reference: Vec<String>,
    /// Column across.
    pub x: String,
    /// Column up.
    pub y: String,
    /// Columns whose values name the series.
    #[serde(default)]
    pub by: Vec<String>,
    /// Column of half widths of intervals around y.
    #[serde(default)]
    pub error: Option<String>,
    /// Only rows with these values in these columns.
    #[serde(default)]
    pub only: BTreeMap<String, Values>,
    /// Scale across.
    #[serde(default)]
    pub x_scale: Scale,
    /// Scale up.
    #[serde(default)]
    pub y_scale: Scale,
    /// Points only, not joined by lines?
    #[serde(default)]
    pub points: bool,
    /// With the frontier: what no other point beats on both axes?
    #[serde(default)]
    pub frontier: bool,
    /// What stands below the axis across [default: the column's name].
    #[serde(default)]
    pub x_label: Option<String>,
    /// What stands beside the axis up [default: the column's name].
    #[serde(default)]
    pub y_label: Option<String>,
    /// Further columns for the data below the chart.
    #[serde(default)]
    pub data: Vec<String>,
}

impl ChartBlock {
    /// The columns that it is made of, and those that are to be shown with it.
    pub(super) fn columns(&self) -> impl Iterator<Item = &str> {
        let by = self.by.iter().map(|name| &**name);
        let drawn = [&*self.x, &*self.y].into_iter().chain(self.error.as_deref());
        by.chain(drawn).chain(self.data.iter().map(|name| &**name))
    }
}

/// A table.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableBlock {
    /// What stands above it.
    #[serde(default)]
    pub title: String,
    /// What is to be said of it, in Markdown.
    #[serde(default)]
    pub text: String,
    /// Behind its title, until that is clicked?
    #[serde(default)]
    pub folded: bool,
    /// By which links reach it.
    #[serde(default)]
    pub id: Option<String>,
    /// The command that makes its tables.
    #[serde(default)]
    pub command: Option<String>,
    /// CSV files, one below the other.
    pub tables: Vec<String>,
    /// Tables to look further columns up in.
    #[serde(default)]
    pub join: Vec<Join>,
    /// Only rows with these values in these columns.
    #[serde(default)]
    pub only: BTreeMap<String, Values>,
    /// Columns to sort by, the first one first; `-` before a name: the greatest first.
    #[serde(default)]
    pub sort: Vec<String>,
    /// What is shown [default: every column].
    #[serde(default)]
    pub columns: Vec<Shown>,
}

/// A table to look further columns up in; they are called `NAME.COLUMN`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Join {
    /// What stands before the dot.
    pub name: String,
    /// The CSV file.
    pub table: String,
    /// Columns that have to have the same values in both.
    pub on: Vec<String>,
}

/// A column of a table.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Shown {
    /// As it is, under its name.
    Plain(String),
    /// With more to say.
    Full(ShownColumn),
}

/// A column of a table, with its heading and format.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShownColumn {
    /// A column of the table, or `NAME.COLUMN` of a joined one.
    #[serde(default)]
    pub column: Option<String>,
    /// Or the ratio of two columns.
    #[serde(default)]
    pub ratio: Option<[String; 2]>,
    /// The column of half widths of the intervals around it.
    #[serde(default)]
    pub error: Option<String>,
    /// What stands above it [default: the column's name].
    #[serde(default)]
    pub heading: Option<String>,
    /// How its numbers are written.
    #[serde(default)]
    pub format: Option<String>,
}

/// A picture: a PNG file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PictureBlock {
    /// The file.
    pub file: String,
    /// What it shows, for those who do not see it.
    pub alt: String,
    /// What stands below it, in Markdown.
    #[serde(default)]
    pub caption: String,
    /// By which links reach it.
    #[serde(default)]
    pub id: Option<String>,
    /// The command that makes it.
    #[serde(default)]
    pub command: Option<String>,
}

/// A text between other blocks.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Paragraph {
    /// Its heading, below that of the section.
    #[serde(default)]
    pub heading: String,
    /// By which links reach it.
    #[serde(default)]
    pub id: Option<String>,
    /// What it says, in Markdown.
    pub text: String,
}
