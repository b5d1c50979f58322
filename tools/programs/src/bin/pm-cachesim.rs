//! Simulates caches over a trace and prints what each would fetch.

use anyhow::Context as _;
use clap::{CommandFactory as _, Parser};
use pm_caches::{CacheConfig, LaneSource, Lanes, Measures, ResultMemory, Simulation, Span, WindowError, Windows};
use pm_exchange::traces::{self, Opened, imports};
use pm_formats::Header;
use pm_formats::trace::{Access, TraceReader, TraceSink};
use pm_programs::cli::choice;
use pm_programs::cli::{self, Progress, Typed, Voice, create_output, named, open_bytes, usage};
use pm_report::Format;
use pm_size::Bytes;
use std::io::{Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[path = "pm-cachesim/columns.rs"]
mod columns;
#[path = "pm-cachesim/foreign_args.rs"]
mod foreign_args;
#[path = "pm-cachesim/found.rs"]
mod found;
#[path = "pm-cachesim/miss_file.rs"]
mod miss_file;
#[path = "pm-cachesim/results.rs"]
mod results;
#[path = "pm-cachesim/sizes.rs"]
mod sizes;
#[path = "pm-cachesim/traffic.rs"]
mod traffic;
#[path = "pm-cachesim/windowed.rs"]
mod windowed;

use foreign_args::ForeignArgs;
use results::{Results, Source};
use sizes::Sizes;

/// Simulate caches over an access trace: how much memory traffic is left?
///
/// All caches asked for are simulated in one reading of the trace. An access is one whole record, read when a search
/// reaches it; a record that spans two lines is two line accesses. A `fetch` is a line that was not in the cache; `per
/// block` divides by the number of lines that the map occupies. The table shows the columns that people compare, csv and
/// json have all. Traces of other simulators are read too, plain or compressed: texts tell their format by their first line,
/// binary ones have to be named with --input. They have no queries, and their blocks are those of the 4 KiB pages they
/// touch. Of a trace of windows (pm-queries --only-tiles, pm-sample --every) each window is simulated from an empty cache, and the numbers are estimates with 95 % intervals.
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
    /// The curve from this share of the lines (SHARDS), with its error; beside the exact one with --curve
    #[arg(long, value_name = "R", conflicts_with_all = ["cache", "ways"], value_parser = rate, hide_short_help = true)]
    shards: Option<f64>,
    /// Write what the one --cache fetches as a trace, for a further cache; `-` is standard output, then no table
    #[arg(long, value_name = "FILE", requires = "cache", conflicts_with_all = ["curve", "shards", "lanes", "input"])]
    misses: Option<PathBuf>,
    /// Which lines a record touches that does not lie in one
    #[arg(long, default_value = "both", hide_short_help = true, value_parser = choice::<Span>())]
    span: Span,
    /// DRAM page (row) to count page switches by, a power of two
    #[arg(long, value_name = "SIZE", default_value = "8K", hide_short_help = true)]
    page: Bytes,
    /// Write-back cache of 32-byte sectors that results go through; where a batch is a tile whose pixels fit in it, they
    /// stay on chip until the batch is over
    #[arg(long, value_name = "SIZE", default_value = "16K", hide_short_help = true)]
    result_cache: Bytes,
    /// Bytes of a pixel in memory
    #[arg(long, value_name = "BYTES", default_value = "12", hide_short_help = true,
        value_parser = clap::value_parser!(u32).range(1..=4096))]
    pixel: u32,
    /// Searches in flight at a time, accesses one of each in turn; a list: a row for each number
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = clap::value_parser!(u16).range(1..))]
    lanes: Vec<u16>,
    /// Which searches fly together: the next of the stream, or one of each of as many parts of a batch
    #[arg(long, value_name = "HOW", default_value = "stream", requires = "lanes", hide_short_help = true, value_parser = choice::<LaneSource>())]
    lanes_from: LaneSource,
    #[command(flatten)]
    foreign: ForeignArgs,
    /// How to print the result
    #[arg(long, default_value = "table", value_parser = choice::<Format>())]
    format: Format,
    #[command(flatten)]
    voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-cachesim --sizes 4K..4M --lines 64,128 scanline.pmt hilbert.pmt
  pm-cachesim --ways full,8 --policies lru,plru,min --format csv trace.pmt
  pm-cachesim --cache 16K,4,64,lru,hash --misses - trace.pmt | pm-cachesim --curve";

fn main() -> ExitCode {
    cli::main_of("pm-cachesim", ForeignArgs::of_formats(Args::command(), &imports()), run)
}

fn run(args: Args, typed: &Typed) -> anyhow::Result<()> {
    let configs = configurations(&args)?;
    let measures = measures(&args)?;
    if args.traces.iter().filter(|trace| *trace == Path::new("-")).count() > 1 {
        return Err(usage("standard input (`-`) can be read only once"));
    }
    let mut results = Results::default();
    if let Some(file) = &args.misses {
        let (&[cache], [trace]) = (&configs[..], &args.traces[..]) else {
            return Err(usage("--misses is for one --cache and one trace"));
        };
        miss_file::write(&args, typed, trace, cache, measures, file, &mut results)?;
        if file == Path::new("-") {
            return Ok(());
        }
    } else {
        for trace in &args.traces {
            simulate(&args, trace, &configs, &measures, &mut results)?;
        }
    }
    // The table is written when every trace was read to its end: a broken pipe yields none.
    let table = match is_curve(&args) {
        true => columns::of_curves(args.format, &results.points),
        false => columns::of_caches(args.format, &results.rows),
    };
    let mut text = Vec::new();
    table.write(args.format, &mut text)?;
    let mut output = create_output(Path::new("-"))?;
    output.write_all(&text)?;
    output.commit()
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
    if !args.cache.is_empty() || is_curve(args) {
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

/// Whether sizes of a curve are printed, and no caches one by one.
fn is_curve(args: &Args) -> bool {
    args.curve || args.shards.is_some()
}

/// What to find out besides the caches' own counts: what the format shows.
fn measures(args: &Args) -> anyhow::Result<Measures> {
    if !args.page.0.is_power_of_two() {
        return Err(usage(format!("--page {}: a power of two is expected, such as 8K", args.page)));
    }
    let mut measures = Measures { span: args.span, ..Measures::default() };
    if is_curve(args) {
        measures.curves = lines(args)?;
        measures.sampled = args.shards;
        measures.exact_too = args.curve;
    } else if args.format != Format::Table {
        measures.split = true;
        measures.page_bytes = Some(args.page.0);
        measures.working_sets = true;
        // The tile, if there is one, is the trace's.
        measures.results =
            Some(ResultMemory { cache_bytes: args.result_cache.0, pixel_bytes: args.pixel, tile_pixels: None });
    }
    Ok(measures)
}

/// The measures, given what the trace says.
fn for_trace(measures: &Measures, header: &Header) -> Measures {
    let results = measures.results.map(|memory| ResultMemory { tile_pixels: traffic::tile_pixels(header), ..memory });
    Measures { results, ..measures.clone() }
}

fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 1.0 => Ok(x),
        _ => Err("a share of the lines above 0 and at most 1 is expected, such as 0.1".into()),
    }
}

/// Simulates all caches on one trace.
fn simulate(
    args: &Args,
    path: &Path,
    configs: &[CacheConfig],
    measures: &Measures,
    results: &mut Results,
) -> anyhow::Result<()> {
    let name = named(path);
    let reading = args.foreign.reading();
    let opened = open_bytes(path).and_then(|input| traces::open(input, &reading, &imports()).context(name.clone()))?;
    match opened {
        Opened::Ours(blocks) => {
            let trace = TraceReader::from_blocks(blocks).context(name.clone())?;
            let measures = for_trace(measures, trace.header());
            simulate_ours(args, trace, configs, &measures, results).context(name)
        }
        Opened::Foreign(mut trace) => {
            if args.lanes.iter().any(|&lanes| lanes > 1) {
                return Err(usage(format!("{name}: a foreign trace has no searches for --lanes to let fly together")));
            }
            if let Some(remark) = args.foreign.left_out(trace.left_out()) {
                args.voice.remark(format!("{name}: {remark}"));
            }
            // Nor has it queries whose results would go anywhere.
            let measures = Measures { results: None, ..measures.clone() };
            let mut simulation = Simulation::measuring(trace.regions(), configs, &measures).context(name.clone())?;
            trace.replay(&mut simulation).context(name)?;
            let source = Source::foreign(trace.format().word().to_owned(), trace.regions());
            results.add(args, &source, 1, simulation.findings())
        }
    }
}

/// Simulates all caches on one of our traces, once for each number of lanes.
fn simulate_ours<R: Read>(
    args: &Args,
    mut trace: TraceReader<R>,
    configs: &[CacheConfig],
    measures: &Measures,
    results: &mut Results,
) -> anyhow::Result<()> {
    let regions = trace.header().regions.clone();
    if let Some(sample) = windowed::sample(trace.header())? {
        windowed::refuse(args)?;
        let mut windows = Windows::new(&regions, configs, measures).map_err(|error| match error {
            WindowError::Policy(_) => asked_wrongly(error),
            error => error.into(),
        })?;
        replay(args, &mut trace, &mut windows)?;
        let rows = windows.finish(Some(sample.windows), sample.share);
        results.add_windows(&Source::ours(trace.header(), trace.end()?), rows);
        return Ok(());
    }
    if args.lanes.is_empty() {
        let mut simulation = Simulation::measuring(&regions, configs, measures)?;
        replay(args, &mut trace, &mut simulation)?;
        return results.add(args, &Source::ours(trace.header(), trace.end()?), 1, simulation.findings());
    }
    let lanes = |&lanes: &u16| -> anyhow::Result<_> {
        // Where searches are mixed, an access belongs to none of them.
        let measures = Measures { working_sets: measures.working_sets && lanes == 1, ..measures.clone() };
        let simulation = Simulation::measuring(&regions, configs, &measures)?;
        Lanes::new(simulation, lanes, args.lanes_from).context("temporary file")
    };
    let mut together = Together(args.lanes.iter().map(lanes).collect::<anyhow::Result<_>>()?);
    replay(args, &mut trace, &mut together)?;
    let source = Source::ours(trace.header(), trace.end()?);
    for (&lanes, simulation) in args.lanes.iter().zip(together.0) {
        results.add(args, &source, lanes, simulation.finish().context("temporary file")?.findings())?;
    }
    Ok(())
}

/// Replays a trace to its end.
fn replay<R: Read>(args: &Args, trace: &mut TraceReader<R>, sink: &mut impl TraceSink) -> anyhow::Result<()> {
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(sink)? {
        progress.add(u64::from(block.records));
    }
    Ok(())
}

/// The same trace through several numbers of lanes.
struct Together(Vec<Lanes<Simulation>>);

impl TraceSink for Together {
    fn block(&mut self, batch: u64, warm_up: bool) {
        self.0.iter_mut().for_each(|sink| sink.block(batch, warm_up));
    }
    fn search(&mut self, destinations: &[u32]) {
        self.0.iter_mut().for_each(|sink| sink.search(destinations));
    }
    fn access(&mut self, access: Access) {
        self.0.iter_mut().for_each(|sink| sink.access(access));
    }
    fn search_end(&mut self) {
        self.0.iter_mut().for_each(TraceSink::search_end);
    }
}
