//! Simulates caches over a trace and prints what each would fetch.

use anyhow::Context as _;
use clap::Parser;
use pm_formats::trace::TraceReader;
use pm_tools::cache::{CacheConfig, Curve, Measures, Simulation, Ways};
use pm_tools::cli::{self, Progress, Typed, Voice, create_output, named, open_input, usage};
use pm_tools::report::Format;
use pm_tools::size::Bytes;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::rc::Rc;

#[path = "pm-cachesim/columns.rs"]
mod columns;
#[path = "pm-cachesim/sizes.rs"]
mod sizes;

use columns::{CacheResult, CurvePoint};
use sizes::Sizes;

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
    /// Cache sizes, combined with each of --lines, --ways and --policies; 4K..4M is each power of two between [default: 128K]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    sizes: Vec<Sizes>,
    /// Line sizes
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "128")]
    lines: Vec<Bytes>,
    /// Ways: `full` or numbers
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "full")]
    ways: Vec<String>,
    /// Policies: lru, fifo, clock, random, random:SEED, plru (tree), min (Belady's optimum), min-bypass
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "lru")]
    policies: Vec<String>,
    /// Fully associative LRU of every size instead, in one pass: csv and json have all sizes at which a count changes,
    /// the table has powers of two, the cliff and the size that holds all; or the --sizes given
    #[arg(long, conflicts_with_all = ["cache", "ways", "policies"])]
    curve: bool,
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
  pm-cachesim --cache 128K,8,128,lru --cache 128K,8,128,lru,hash --format csv trace.pmt
  pm-cachesim --curve --lines 32,64,128 trace.pmt";

fn main() -> ExitCode {
    cli::main("pm-cachesim", run)
}

fn run(args: Args, _: &Typed) -> anyhow::Result<()> {
    let configs = configurations(&args)?;
    let measures = Measures { curves: if args.curve { lines(&args)? } else { vec![] } };
    if args.traces.iter().filter(|trace| *trace == Path::new("-")).count() > 1 {
        return Err(usage("standard input (`-`) can be read only once"));
    }
    let mut results = Results::default();
    for trace in &args.traces {
        simulate(&args, trace, &configs, &measures, &mut results)?;
    }
    // The table is written when every trace was read to its end: a broken pipe yields none.
    let table = match args.curve {
        true => columns::of_curves(args.format, &results.points),
        false => columns::of_caches(args.format, &results.rows),
    };
    let mut text = Vec::new();
    table.write(args.format, &mut text)?;
    let mut output = create_output(Path::new("-"))?;
    output.write_all(&text)?;
    output.commit()
}

/// What is printed at the end.
#[derive(Default)]
struct Results {
    rows: Vec<CacheResult>,
    points: Vec<CurvePoint>,
}

/// The sizes asked for.
fn sizes(args: &Args) -> Vec<Bytes> {
    args.sizes.iter().flat_map(|sizes| sizes.0.clone()).collect()
}

/// The line sizes asked for.
fn lines(args: &Args) -> anyhow::Result<Vec<u32>> {
    // Whatever the size, the line must do.
    let line = |line: &Bytes| Ok(format!("none,{line}").parse::<CacheConfig>().map_err(asked_wrongly)?.line_bytes());
    args.lines.iter().map(line).collect()
}

fn asked_wrongly(error: impl std::fmt::Display) -> anyhow::Error {
    usage(error.to_string())
}

fn configurations(args: &Args) -> anyhow::Result<Vec<CacheConfig>> {
    if !args.cache.is_empty() || args.curve {
        return Ok(args.cache.clone());
    }
    let mut sizes = sizes(args);
    if sizes.is_empty() {
        sizes.push(DEFAULT_SIZE);
    }
    let mut configs = vec![];
    for line in &args.lines {
        for size in &sizes {
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

/// The paper's cache.
const DEFAULT_SIZE: Bytes = Bytes(128 << 10);

fn simulate(
    args: &Args,
    path: &Path,
    configs: &[CacheConfig],
    measures: &Measures,
    results: &mut Results,
) -> anyhow::Result<()> {
    let name = named(path);
    let mut trace = TraceReader::from_blocks(open_input(path)?).context(name.clone())?;
    let mut simulation = Simulation::measuring(&trace.header().regions, configs, measures).context(name.clone())?;
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(&mut simulation).with_context(|| name.clone())? {
        progress.add(u64::from(block.records));
    }
    drop(progress);
    let order = order_of(trace.header());
    let findings = simulation.findings();
    results.rows.extend(findings.rows.into_iter().map(|row| CacheResult { order: order.clone(), row }));
    for curve in findings.curves {
        let curve = Rc::new(curve);
        for lines in curve_sizes(args, &curve)? {
            results.points.push(CurvePoint { order: order.clone(), curve: Rc::clone(&curve), lines });
        }
    }
    Ok(())
}

/// Sizes of a curve to print, in lines.
fn curve_sizes(args: &Args, curve: &Curve) -> anyhow::Result<Vec<u64>> {
    let line = curve.trace.line_bytes;
    match (sizes(args), args.format) {
        (sizes, Format::Table) if sizes.is_empty() => Ok(curve.readable()),
        (sizes, _) if sizes.is_empty() => Ok(curve.changes().collect()),
        (sizes, _) => sizes
            .into_iter()
            .map(|size| Ok(CacheConfig::lru(size.0, Ways::Full, line).map_err(asked_wrongly)?.lines()))
            .collect(),
    }
}

/// The order of the queries, as the stream tells it: `tiled 16x16, hilbert per batch`.
fn order_of(header: &pm_formats::Header) -> String {
    let parts = ["order", "deferred order"].into_iter().filter_map(|name| header.meaning(name));
    parts.collect::<Vec<_>>().join(", ")
}
