//! Draws charts of tables, and puts charts, tables, pictures and text on a page.

use anyhow::{Context as _, anyhow};
use clap::Parser;
use pm_formats::as_commands;
use pm_programs::cli::choice;
use pm_programs::cli::{self, OutputArgs, Typed, Voice, named, open_bytes, usage};
use pm_report::chart::{Look, Plot, Scale, Selection, TableError};
use pm_report::page::{ChartBlock, Description, PageError, Sheets, Values};
use std::collections::BTreeMap;
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Draw a chart of CSV tables, such as those of `pm-cachesim --format csv`, as SVG; or a page of many, as HTML.
///
/// One column across, one up, a series for each value of another. Logarithmic axes are chosen where the values span more
/// than a factor of 20. A column of words makes an axis of words, in the order of the table.
/// An output named *.html is a page with the chart and its data.
///
/// With --page a description in TOML says what stands on the page: a title, `[numbers]` for the texts, and in each
/// `[[section]]` a heading, Markdown and blocks, `[[section.chart]]` (tables, x, y and what else there are options for),
/// `[[section.table]]` (tables, columns, only, sort, join), `[[section.picture]]` (file, alt, caption) and
/// `[[section.paragraph]]`. Texts take their numbers from tables: `{{ t.csv[order=hilbert].fetches / 1000 | .1f }}`. The
/// page is one file that needs no other. The module `page` of the code tells all that a description may say.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// Tables to read; `-` is standard input
    #[arg(default_value = "-", conflicts_with = "page")]
    tables: Vec<PathBuf>,
    /// Column across
    #[arg(short, value_name = "COLUMN", required_unless_present = "page")]
    x: Option<String>,
    /// Column up
    #[arg(short, value_name = "COLUMN", required_unless_present = "page")]
    y: Option<String>,
    /// Columns whose values name the series [default: a series for each table]
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    by: Vec<String>,
    /// Column of half widths of the intervals around y
    #[arg(long, value_name = "COLUMN")]
    error: Option<String>,
    /// Only rows with this value in this column; may be repeated: of a column's values any, of all columns one
    #[arg(long, value_name = "COLUMN=VALUE", value_parser = only)]
    only: Vec<(String, String)>,
    /// A table with the same columns to compare with, in grey; may be repeated
    #[arg(long, value_name = "FILE")]
    reference: Vec<PathBuf>,
    /// Scale across
    #[arg(long, value_name = "SCALE", default_value = "auto", value_parser = choice::<Scale>())]
    x_scale: Scale,
    /// Scale up
    #[arg(long, value_name = "SCALE", default_value = "auto", value_parser = choice::<Scale>())]
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
    /// Write the page that this TOML file describes
    #[arg(long, value_name = "FILE",
        conflicts_with_all = ["x", "y", "by", "error", "only", "reference", "points", "frontier", "title", "size"])]
    page: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
    #[command(flatten)]
    voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-cachesim --sizes 4K,32K,256K,2M --format csv *.pmt | pm-chart -x size -y fetches_per_query --by order -o sizes.svg
  pm-chart -x ways -y fetches --by order --title 'What associativity costs' ways.csv -o ways.svg
  pm-chart -x storage -y total_bytes --by order --points --frontier frontier.csv -o frontier.html
  pm-chart --page report.toml -o report.html";

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

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    let text = match &args.page {
        Some(path) => described(path)?,
        None if args.output.output.as_ref().is_some_and(|path| path.extension().is_some_and(|e| e == "html")) => {
            page_of_chart(&args, typed)?
        }
        None => svg(&args)?,
    };
    let mut output = args.output.create()?;
    output.write_all(text.as_bytes())?;
    output.commit()
}

fn svg(args: &Args) -> anyhow::Result<String> {
    let open = |path: &PathBuf| anyhow::Ok((named(path), open_bytes(path)?));
    let tables = args.tables.iter().map(open).collect::<Result<Vec<_>, _>>()?;
    let references = args.reference.iter().map(open).collect::<Result<Vec<_>, _>>()?;
    let selection = Selection {
        x: args.x.clone().unwrap_or_default(),
        y: args.y.clone().unwrap_or_default(),
        by: args.by.clone(),
        error: args.error.clone(),
        only: args.only.clone(),
        x_scale: args.x_scale,
        y_scale: args.y_scale,
    };
    let mut plot = Plot::read(&selection, tables, references).map_err(|error| match error {
        // What the table holds is not the asker's fault; which columns are asked for is.
        TableError::Csv { .. } | TableError::Empty(_) | TableError::Number { .. } => error.into(),
        _ => usage(error.to_string()),
    })?;
    plot.x.label = args.x_label.clone().unwrap_or(plot.x.label);
    plot.y.label = args.y_label.clone().unwrap_or(plot.y.label);
    let look =
        Look { title: args.title.clone(), size: args.size, lines: !args.points, frontier: args.frontier, legend: true };
    Ok(plot.svg(&look))
}

/// The page that a description asks for.
fn described(path: &Path) -> anyhow::Result<String> {
    let name = named(path);
    let mut text = String::new();
    open_bytes(path)?.read_to_string(&mut text).with_context(|| name.clone())?;
    let page = |error: PageError| match error.asked_wrongly() {
        true => usage(format!("{name}, {error}")),
        false => anyhow!("{name}, {error}"),
    };
    let description = Description::parse(&text).map_err(page)?;
    let own = path.parent().filter(|_| path != Path::new("-")).unwrap_or(Path::new(""));
    let mut sheets = Sheets::of_folder(&own.join(&description.folder));
    description.html(&mut sheets, &generator()).map_err(page)
}

/// A page with the one chart and its table.
fn page_of_chart(args: &Args, typed: &Typed) -> anyhow::Result<String> {
    let mut sheets = Sheets::default();
    let mut names = vec![];
    let fault = |error: PageError| match error.asked_wrongly() {
        true => usage(error.to_string()),
        false => anyhow!("{error}"),
    };
    for path in args.tables.iter().chain(&args.reference) {
        let mut text = vec![];
        open_bytes(path)?.read_to_end(&mut text).with_context(|| named(path))?;
        sheets.add(&named(path), text).map_err(fault)?;
        names.push(named(path));
    }
    let reference = names.split_off(args.tables.len());
    let mut only: BTreeMap<String, Vec<String>> = BTreeMap::new();
    args.only.iter().for_each(|(column, value)| only.entry(column.clone()).or_default().push(value.clone()));
    let chart = ChartBlock {
        title: args.title.clone(),
        command: Some(as_commands(&[typed.step(None)]).trim_end().to_owned()),
        tables: names,
        reference,
        x: args.x.clone().unwrap_or_default(),
        y: args.y.clone().unwrap_or_default(),
        by: args.by.clone(),
        error: args.error.clone(),
        only: only.into_iter().map(|(column, values)| (column, Values::Any(values))).collect(),
        x_scale: args.x_scale,
        y_scale: args.y_scale,
        points: args.points,
        frontier: args.frontier,
        x_label: args.x_label.clone(),
        y_label: args.y_label.clone(),
        ..ChartBlock::default()
    };
    Description::of_chart(chart).html(&mut sheets, &generator()).map_err(fault)
}

/// What a page says of the program that wrote it.
fn generator() -> String {
    format!("pm-chart {}", cli::VERSION)
}
