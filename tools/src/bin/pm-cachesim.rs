//! Simulates caches over a trace and prints what each would fetch.

use anyhow::Context as _;
use clap::Parser;
use pm_formats::trace::TraceReader;
use pm_formats::{End, Header, Number, StageReport};
use pm_tools::cache::{
    CacheConfig, Findings, LEAST_MODEL, Measures, MissStream, Policy, ResultMemory, Simulation, Span, TraceCounts, Ways,
};
use pm_tools::cli::{self, OutputArgs, Progress, Typed, Voice, create_output, named, open_input, usage};
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
#[path = "pm-cachesim/traffic.rs"]
mod traffic;

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
    /// A cache: size, ways (`full` or a number), line size, policy (lru, none); may be repeated
    #[arg(long, value_name = "SIZE,WAYS,LINE,POLICY", conflicts_with_all = ["sizes", "lines", "ways"])]
    cache: Vec<CacheConfig>,
    /// Cache sizes, combined with each of --lines and --ways; 4K..4M is each power of two between [default: 128K]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    sizes: Vec<Sizes>,
    /// Line sizes
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "128")]
    lines: Vec<Bytes>,
    /// Ways: `full` or numbers
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "full")]
    ways: Vec<String>,
    /// Fully associative LRU of every size instead, in one pass: csv and json have all sizes at which a count changes,
    /// the table has powers of two, the cliff and the size that holds all; or the --sizes given
    #[arg(long, conflicts_with_all = ["cache", "ways"])]
    curve: bool,
    /// The curve from this share of the lines (SHARDS), with its error; beside the exact one with --curve
    #[arg(long, value_name = "R", conflicts_with_all = ["cache", "ways"], value_parser = rate, hide_short_help = true)]
    shards: Option<f64>,
    /// Write what the one --cache fetches as a trace, for a further cache; `-` is standard output, then no table
    #[arg(long, value_name = "FILE", requires = "cache", conflicts_with_all = ["curve", "shards"])]
    misses: Option<PathBuf>,
    /// Which lines a record touches that does not lie in one
    #[arg(long, default_value = "both", hide_short_help = true)]
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
    /// How to print the result
    #[arg(long, default_value = "table")]
    format: Format,
    #[command(flatten)]
    voice: Voice,
}

const EXAMPLES: &str = "\
Examples:
  pm-queries | pm-reorder hilbert | pm-gather | pm-cachesim
  pm-cachesim --sizes 4K..4M --lines 64,128 scanline.pmt hilbert.pmt
  pm-cachesim --cache 128K,full,128,lru --cache 128K,8,128,lru --format csv trace.pmt
  pm-cachesim --cache 16K,4,64,lru --misses - trace.pmt | pm-cachesim --curve";

fn main() -> ExitCode {
    cli::main("pm-cachesim", run)
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
        write_misses(&args, typed, trace, cache, measures, file, &mut results)?;
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
                let text = format!("{size},{ways},{line},lru");
                configs.push(text.parse().map_err(|error| usage(format!("{text}: {error}")))?);
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

fn simulate(
    args: &Args,
    path: &Path,
    configs: &[CacheConfig],
    measures: &Measures,
    results: &mut Results,
) -> anyhow::Result<()> {
    let name = named(path);
    let mut trace = TraceReader::from_blocks(open_input(path)?).context(name.clone())?;
    let measures = for_trace(measures, trace.header());
    let mut simulation = Simulation::measuring(&trace.header().regions, configs, &measures).context(name.clone())?;
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(&mut simulation).with_context(|| name.clone())? {
        progress.add(u64::from(block.records));
    }
    drop(progress);
    results.add(args, trace.header(), trace.end()?, simulation.findings())
}

/// Simulates one cache and writes what it fetches.
fn write_misses(
    args: &Args,
    typed: &Typed,
    path: &Path,
    cache: CacheConfig,
    measures: Measures,
    file: &Path,
    results: &mut Results,
) -> anyhow::Result<()> {
    if cache.policy() == Policy::None {
        return Err(usage("--misses: without a cache nothing is kept back; name one that has lines"));
    }
    let name = named(path);
    let mut trace = TraceReader::from_blocks(open_input(path)?).context(name.clone())?;
    let measures = for_trace(&measures, trace.header());
    let mut header = trace.header().clone();
    let through = header.meaning("misses of").map_or(cache.to_string(), |first| format!("{first}, {cache}"));
    header.set_meaning("misses of", through);
    let mut step = typed.step_from(path, None);
    step.arguments = misses_to_pipe(step.arguments);
    header.history.push(step);
    let output = OutputArgs { output: Some(file.to_owned()) }.create()?;
    let mut stream = MissStream::new(output, header, cache, &measures).context(name.clone())?;
    let progress = Progress::new(trace.header().expected_records, "searches", args.voice.quiet);
    while let Some(block) = trace.replay_block(&mut stream).with_context(|| name.clone())? {
        stream.end_block(block)?;
        progress.add(u64::from(block.records));
    }
    drop(progress);
    let end = trace.end()?;
    let (output, findings) = stream.finish(|row| {
        let report = StageReport::new(typed.program())
            .with("accesses", Number::Count(row.accesses))
            .with("fetches", Number::Count(row.fetches))
            .with("bytes_fetched", Number::Bytes(row.bytes_fetched))
            .with("bytes_written_back", Number::Bytes(row.bytes_written_back));
        end.stages.iter().cloned().chain([report]).collect()
    })?;
    let written_back = findings.rows[0].bytes_written_back;
    if written_back > 0 {
        args.voice
            .remark(format!("{written_back} bytes that the cache writes back are not in the stream of its misses"));
    }
    output.commit()?;
    results.add(args, trace.header(), end, findings)
}

/// The arguments as they stand in the history: the stream does not know its name, nor how the table was printed.
fn misses_to_pipe(typed: Vec<String>) -> Vec<String> {
    let mut kept = vec![];
    let mut words = typed.into_iter();
    while let Some(word) = words.next() {
        match word.split_once('=').map_or(word.as_str(), |(name, _)| name) {
            name @ ("--misses" | "--format") => {
                if !word.contains('=') {
                    words.next();
                }
                if name == "--misses" {
                    kept.extend(["--misses".to_owned(), "-".to_owned()]);
                }
            }
            _ => kept.push(word),
        }
    }
    kept
}

impl Results {
    /// Adds what was found of a trace.
    fn add(&mut self, args: &Args, header: &Header, end: &End, findings: Findings) -> anyhow::Result<()> {
        let order = order_of(header);
        let regions = Rc::new(header.regions.iter().map(|region| region.name.clone()).collect());
        self.rows.extend(findings.rows.into_iter().map(|row| CacheResult {
            order: order.clone(),
            row,
            regions: Rc::clone(&regions),
            query_bytes: traffic::query_bytes(end),
            result_bytes: findings.result_bytes,
        }));
        let mut exact = findings.curves.into_iter().map(Rc::new);
        let mut sampled = findings.sampled.into_iter().map(Rc::new);
        loop {
            let (exact, sampled) = (exact.next(), sampled.next());
            let trace = exact.as_ref().map(|curve| curve.trace).or(sampled.as_ref().map(|curve| curve.trace));
            let Some(trace) = trace else { return Ok(()) };
            let mut point = CurvePoint { order: order.clone(), exact, sampled, trace, lines: 0 };
            for lines in curve_sizes(args, &point)? {
                point.lines = lines;
                self.points.push(point.clone());
            }
        }
    }
}

/// Sizes of a curve to print, in lines.
fn curve_sizes(args: &Args, curve: &CurvePoint) -> anyhow::Result<Vec<u64>> {
    let TraceCounts { line_bytes, blocks, .. } = curve.trace;
    let sizes = sizes(args);
    let lines = |size: Bytes| Ok(CacheConfig::lru(size.0, Ways::Full, line_bytes).map_err(asked_wrongly)?.lines());
    let asked: Vec<u64> = sizes.into_iter().map(lines).collect::<anyhow::Result<_>>()?;
    if let Some(sampled) = &curve.sampled {
        let least = sampled.least();
        let too_small = asked.iter().find(|&&lines| lines < least);
        let sizes = if asked.is_empty() { sampled.sizes(blocks) } else { asked.clone() };
        if let Some(&lines) = too_small.or(sizes.is_empty().then_some(&blocks)) {
            return Err(usage(format!(
                "--shards {}: nothing can be said of {lines} lines, only of {least} and more, for which {LEAST_MODEL} \
                 stand; a rate of {:.2} would do, or --curve for exact numbers",
                sampled.rate,
                ((LEAST_MODEL / lines.max(1) as f64) * 100.0).ceil().clamp(1.0, 100.0) / 100.0
            )));
        }
        return Ok(sizes);
    }
    match (&curve.exact, args.format) {
        _ if !asked.is_empty() => Ok(asked),
        (Some(exact), Format::Table) => Ok(exact.readable()),
        (Some(exact), _) => Ok(exact.changes().collect()),
        (None, _) => Ok(vec![]),
    }
}

/// The order of the queries, as the stream tells it: `tiled 16x16, hilbert per batch`.
fn order_of(header: &Header) -> String {
    let parts = ["order", "deferred order"].into_iter().filter_map(|name| header.meaning(name).map(str::to_owned));
    parts.chain(header.meaning("misses of").map(|caches| format!("misses of {caches}"))).collect::<Vec<_>>().join(", ")
}
