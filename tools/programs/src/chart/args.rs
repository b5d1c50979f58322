//! What pm-chart can be asked.

use crate::cli::{OutputArgs, Voice, choice};
use clap::Parser;
use pm_report::chart::Scale;
use std::path::PathBuf;

/// Draw a chart of CSV tables, such as those of `pm-cachesim --format csv`, as SVG; or a page of many, as HTML.
///
/// One column across, one up, a series for each value of another. Logarithmic axes are chosen where the values span more
/// than a factor of 20. A column of words makes an axis of words, in the order of the table.
/// An output named *.html is a page with the chart and its data.
///
/// With --page a description in TOML says what stands on the page: a title, `[numbers]` for the texts, and in each
/// `[[section]]` a heading, Markdown and blocks, `[[section.chart]]` (tables, x, y and what else there are options for),
/// `[[section.table]]` (tables, columns, only, sort, join), `[[section.picture]]` (file, alt, caption) and
/// `[[section.paragraph]]`. Texts take their numbers from tables: `{{ row('t.csv', order='hilbert').fetches / 1000 | .1f }}`. The
/// page is one file that needs no other. The module `page` of the code tells all that a description may say.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Tables to read; `-` is standard input
    #[arg(default_value = "-", conflicts_with = "page")]
    pub(super) tables: Vec<PathBuf>,
    /// Column across
    #[arg(short, value_name = "COLUMN", required_unless_present = "page")]
    pub(super) x: Option<String>,
    /// Column up
    #[arg(short, value_name = "COLUMN", required_unless_present = "page")]
    pub(super) y: Option<String>,
    /// Columns whose values name the series [default: a series for each table]
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    pub(super) by: Vec<String>,
    /// Column of half widths of the intervals around y
    #[arg(long, value_name = "COLUMN")]
    pub(super) error: Option<String>,
    /// Only rows with this value in this column; may be repeated: of a column's values any, of all columns one
    #[arg(long, value_name = "COLUMN=VALUE", value_parser = only)]
    pub(super) only: Vec<(String, String)>,
    /// A table with the same columns to compare with, in grey; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(super) reference: Vec<PathBuf>,
    /// Scale across
    #[arg(long, value_name = "SCALE", default_value = "auto", value_parser = choice::<Scale>())]
    pub(super) x_scale: Scale,
    /// Scale up
    #[arg(long, value_name = "SCALE", default_value = "auto", value_parser = choice::<Scale>())]
    pub(super) y_scale: Scale,
    /// Points only, not joined by lines
    #[arg(long)]
    pub(super) points: bool,
    /// Also draw the frontier: what no other point beats on both axes
    #[arg(long)]
    pub(super) frontier: bool,
    /// What stands above the chart
    #[arg(long, default_value = "")]
    pub(super) title: String,
    /// What stands below the axis across [default: the column's name]
    #[arg(long, value_name = "TEXT", hide_short_help = true)]
    pub(super) x_label: Option<String>,
    /// What stands beside the axis up [default: the column's name]
    #[arg(long, value_name = "TEXT", hide_short_help = true)]
    pub(super) y_label: Option<String>,
    /// Width and height in pixels; of each drawing, where more than seven series become several
    #[arg(long, value_name = "WxH", default_value = "880x520", value_parser = size, hide_short_help = true)]
    pub(super) size: (u32, u32),
    /// Write the page that this TOML file describes
    #[arg(long, value_name = "FILE",
        conflicts_with_all = ["x", "y", "by", "error", "only", "reference", "points", "frontier", "title", "size"])]
    pub(super) page: Option<PathBuf>,
    /// Let the page read files outside its own folder, too
    #[arg(long, hide_short_help = true)]
    pub(super) anyway: bool,
    #[command(flatten)]
    pub(super) output: OutputArgs,
    #[command(flatten)]
    pub(super) voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-cachesim --sizes 4K,32K,256K,2M --format csv *.pmt | pm-chart -x cache_bytes -y fetches_per_query --by order -o sizes.svg
  pm-chart -x ways -y fetches --by order --title 'What associativity costs' ways.csv -o ways.svg
  pm-chart -x order_bytes_on_chip -y total_bytes --by order --points --frontier orders.csv -o frontier.html
  pm-chart --page report.toml -o report.html";

fn only(text: &str) -> Result<(String, String), String> {
    let (column, value) =
        text.split_once('=').ok_or("a column, `=` and a value are expected, such as order=hilbert")?;
    Ok((column.to_owned(), value.to_owned()))
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let fits = |&(width, height): &(u32, u32)| (320..=8192).contains(&width) && (200..=8192).contains(&height);
    parsed.filter(fits).ok_or_else(|| "width and height from 320x200 to 8192x8192 are expected, such as 880x520".into())
}
