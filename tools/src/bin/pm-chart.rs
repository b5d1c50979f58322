//! Draws charts of tables.

use clap::Parser;
use pm_tools::chart::{Look, Plot, Scale, Selection, TableError};
use pm_tools::cli::{self, OutputArgs, Typed, Voice, named, open_bytes, usage};
use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

/// Draw a chart of CSV tables, such as those of `pm-cachesim --format csv`, as SVG.
///
/// One column across, one up, a series for each value of another. Logarithmic axes are chosen where the values span more
/// than a factor of 20. A column of words makes an axis of words, in the order of the table.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// Tables to read; `-` is standard input
    #[arg(default_value = "-")]
    tables: Vec<PathBuf>,
    /// Column across
    #[arg(short, value_name = "COLUMN")]
    x: String,
    /// Column up
    #[arg(short, value_name = "COLUMN")]
    y: String,
    /// Columns whose values name the series [default: a series for each table]
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    by: Vec<String>,
    /// Column of half widths of the intervals around y
    #[arg(long, value_name = "COLUMN")]
    error: Option<String>,
    /// Only rows with this value in this column; may be repeated
    #[arg(long, value_name = "COLUMN=VALUE", value_parser = only)]
    only: Vec<(String, String)>,
    /// A table with the same columns to compare with, in grey; may be repeated
    #[arg(long, value_name = "FILE")]
    reference: Vec<PathBuf>,
    /// Scale across
    #[arg(long, value_name = "SCALE", default_value = "auto")]
    x_scale: Scale,
    /// Scale up
    #[arg(long, value_name = "SCALE", default_value = "auto")]
    y_scale: Scale,
    /// Points only, not joined by lines
    #[arg(long)]
    points: bool,
    /// Also draw the frontier: what no other point beats on both axes
    #[arg(long)]
    frontier: bool,
    /// What stands above the chart
    #[arg(long, default_value = "")]
    title: String,
    /// What stands below the axis across [default: the column's name]
    #[arg(long, value_name = "TEXT", hide_short_help = true)]
    x_label: Option<String>,
    /// What stands beside the axis up [default: the column's name]
    #[arg(long, value_name = "TEXT", hide_short_help = true)]
    y_label: Option<String>,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "880x520", value_parser = size, hide_short_help = true)]
    size: (u32, u32),
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-cachesim --sizes 4K,32K,256K,2M --format csv *.pmt | pm-chart -x size -y fetches_per_query --by order -o sizes.svg
  pm-chart -x ways -y fetches --by order --title 'What associativity costs' ways.csv -o ways.svg
  pm-chart -x storage -y total_bytes --by order --points --frontier frontier.csv -o frontier.svg";

fn main() -> ExitCode {
    cli::main("pm-chart", run)
}

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

fn run(args: Args, _: &Typed) -> anyhow::Result<()> {
    let open = |path: &PathBuf| anyhow::Ok((named(path), open_bytes(path)?));
    let tables = args.tables.iter().map(open).collect::<Result<Vec<_>, _>>()?;
    let references = args.reference.iter().map(open).collect::<Result<Vec<_>, _>>()?;
    let selection = Selection {
        x: args.x,
        y: args.y,
        by: args.by,
        error: args.error,
        only: args.only,
        x_scale: args.x_scale,
        y_scale: args.y_scale,
    };
    let mut plot = Plot::read(&selection, tables, references).map_err(|error| match error {
        // What the table holds is not the asker's fault; which columns are asked for is.
        TableError::Csv { .. } | TableError::Empty(_) | TableError::Number { .. } => error.into(),
        _ => usage(error.to_string()),
    })?;
    plot.x.label = args.x_label.unwrap_or(plot.x.label);
    plot.y.label = args.y_label.unwrap_or(plot.y.label);
    let look = Look { title: args.title, size: args.size, lines: !args.points, frontier: args.frontier };
    let mut output = args.output.create()?;
    output.write_all(plot.svg(&look).as_bytes())?;
    output.commit()
}
