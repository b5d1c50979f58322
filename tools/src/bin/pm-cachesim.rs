//! Simulates caches over a trace and prints what each would fetch.

use anyhow::Context as _;
use clap::Parser;
use pm_formats::trace::TraceReader;
use pm_tools::cache::{CacheConfig, Row, Simulation};
use pm_tools::cli::{self, Progress, Typed, Voice, create_output, named, open_input, usage};
use pm_tools::report::{Column, Format, Table, Value};
use pm_tools::size::Bytes;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Simulate caches over an access trace: how much memory traffic is left?
///
/// All caches asked for are simulated in one reading of the trace. An access is one whole record, read when a search
/// reaches it; a record that spans two lines is two line accesses. A `fetch` is a line that was not in the cache; `per
/// block` divides by the number of lines that the map occupies. The table shows the columns that people compare, csv and
/// json have all.
#[derive(Parser)]
#[command(after_help = EXAMPLES)]
struct Args {
    /// Traces to read, a table row for each trace and cache; `-` is standard input
    #[arg(default_value = "-")]
    traces: Vec<PathBuf>,
    /// A cache: size, ways (`full` or a number), line size, policy, and `,hash` to hash the set index; or `none`; may be
    /// repeated
    #[arg(long, value_name = "SIZE,WAYS,LINE,POLICY", conflicts_with_all = ["sizes", "lines", "ways", "policies"])]
    cache: Vec<CacheConfig>,
    /// Cache sizes, combined with each of --lines, --ways and --policies
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "128K")]
    sizes: Vec<Bytes>,
    /// Line sizes
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "128")]
    lines: Vec<Bytes>,
    /// Ways: `full` or numbers
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "full")]
    ways: Vec<String>,
    /// Policies: lru, fifo, clock, random, random:SEED, plru (tree), min (Belady's optimum), min-bypass
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "lru")]
    policies: Vec<String>,
    /// How to print the result
    #[arg(long, default_value = "table")]
    format: Format,
    #[command(flatten)]
    voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-cachesim --sizes 32K,128K,512K --lines 64,128 scanline.pmt hilbert.pmt
  pm-cachesim --ways full,8 --policies lru,plru,min trace.pmt
  pm-cachesim --cache 128K,8,128,lru --cache 128K,8,128,lru,hash --format csv trace.pmt";

fn main() -> ExitCode {
    cli::main("pm-cachesim", run)
}

fn run(args: Args, _: &Typed) -> anyhow::Result<()> {
    let configs = configurations(&args)?;
    if args.traces.iter().filter(|trace| *trace == Path::new("-")).count() > 1 {
        return Err(usage("standard input (`-`) can be read only once"));
    }
    let mut table = Table::new(columns(args.format));
    for trace in &args.traces {
        simulate(&args, trace, &configs, &mut table)?;
    }
    // The table is written when every trace was read to its end: a broken pipe yields none.
    let mut text = Vec::new();
    table.write(args.format, &mut text)?;
    let mut output = create_output(Path::new("-"))?;
    output.write_all(&text)?;
    output.commit()
}

fn configurations(args: &Args) -> anyhow::Result<Vec<CacheConfig>> {
    if !args.cache.is_empty() {
        return Ok(args.cache.clone());
    }
    let mut configs = vec![];
    for line in &args.lines {
        for size in &args.sizes {
            for ways in &args.ways {
                for policy in &args.policies {
                    let text = format!("{size},{ways},{line},{policy}");
                    configs.push(text.parse().map_err(|error| usage(format!("{text}: {error}")))?);
                }
            }
        }
    }
    Ok(configs)
}

fn simulate(args: &Args, path: &Path, configs: &[CacheConfig], table: &mut Table) -> anyhow::Result<()> {
    let name = named(path);
    let mut trace = TraceReader::from_blocks(open_input(path)?).context(name.clone())?;
    let mut simulation = Simulation::new(&trace.header().regions, configs).context(name.clone())?;
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(&mut simulation).with_context(|| name.clone())? {
        progress.add(u64::from(block.records));
    }
    drop(progress);
    let order = order_of(trace.header());
    for row in simulation.finish() {
        table.push(values(args.format, &order, &row));
    }
    Ok(())
}

/// The order of the queries, as the stream tells it: `tiled 16x16, hilbert per batch`.
fn order_of(header: &pm_formats::Header) -> String {
    let parts = ["order", "deferred order"].into_iter().filter_map(|name| header.meaning(name));
    parts.collect::<Vec<_>>().join(", ")
}

/// Columns of the result: name, and is it one that the table shows?
const COLUMNS: [(&str, bool); 15] = [
    ("order", true),
    ("cache", true),
    ("queries", true),
    ("reads", false),
    ("raw_bytes", false),
    ("accesses", false),
    ("fetches", true),
    ("bytes_fetched", true),
    ("bytes_written_back", false),
    ("compulsory", false),
    ("blocks", false),
    ("reads_per_query", true),
    ("fetches_per_query", true),
    ("fetches_per_block", true),
    ("bytes_per_query", false),
];

/// Significant digits of ratios in the table.
const DIGITS: u8 = 5;

/// Which columns a format has.
fn shown(format: Format) -> impl Fn(&(usize, &(&str, bool))) -> bool {
    move |&(_, &(_, in_table))| in_table || format != Format::Table
}

fn columns(format: Format) -> Vec<Column> {
    let column = |(index, &(name, _)): (usize, &(&str, bool))| match index {
        0 | 1 => Column::text(name),
        _ => Column::number(name),
    };
    COLUMNS.iter().enumerate().filter(shown(format)).map(column).collect()
}

fn values(format: Format, order: &str, row: &Row) -> Vec<Value> {
    let ratio = |x: f64| Value::Float(x, DIGITS);
    let all = [
        Value::Text(order.to_owned()),
        Value::Text(row.config.to_string()),
        Value::Int(row.queries),
        Value::Int(row.records.reads),
        Value::Int(row.raw_bytes()),
        Value::Int(row.accesses),
        Value::Int(row.fetches),
        Value::Int(row.bytes_fetched),
        Value::Int(row.bytes_written_back),
        Value::Int(row.compulsory),
        Value::Int(row.blocks),
        ratio(row.reads_per_query()),
        ratio(row.fetches_per_query()),
        ratio(row.fetches_per_block()),
        ratio(row.bytes_per_query()),
    ];
    let shown = shown(format);
    all.into_iter()
        .zip(COLUMNS.iter().enumerate())
        .filter(|(_, column)| shown(column))
        .map(|(value, _)| value)
        .collect()
}
